#pragma once
#include "physics/interaction.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Forces and pressures of loads: dead loads, which keep their direction.
template <int Dim>
class AppliedLoads final : public Interaction<Dim> {
 public:
    AppliedLoads(const Model<Dim>& model, const Physics& physics, State<Dim>& state);
    static bool exist(const Physics& physics);

    StageNames stages() const override { return {.move = "applied loads"}; }
    void start(State<Dim>& state) override { move(state, 0); }
    /// Forces at the current time, and their work over the step by the trapezoidal rule.
    void move(State<Dim>& state, double step) override;
    void add_forces(State<Dim>& state, int begin, int end) const override;
    void add_static_loads(const State<Dim>& state, double time, double share,
                          StaticLoads<Dim>& loads) const override;
    void take_static_loads(State<Dim>& state, double time, double share) override;
    void add_static_work(const State<Dim>& before, State<Dim>& now) const override;
    double load(const State<Dim>& state, int load) const override;
    void release(State<Dim>& state, int load) override;

 private:
    /// The force on one particle of a load; its values lie in this order in the memory.
    struct Applied {
        int load = 0, particle = 0;
        std::size_t place = 0;  ///< among the particles of the load
    };
    Vec<Dim> force_at(const Applied& of, double time) const;
    auto now(State<Dim>& state, std::size_t k) const;
    auto now(const State<Dim>& state, std::size_t k) const;

    const Model<Dim>& model_;
    const std::vector<Load>& loads_;
    std::vector<Applied> applied_;
    std::vector<std::size_t> load_start_;   ///< those of load l: applied_[load_start_[l]] and on
    std::vector<std::size_t> by_particle_;  ///< into applied_
    std::vector<int> block_start_;  ///< those of block b of particles: by_particle_[block_start_[b]] and on
    int memory_ = 0;                ///< forces now (N), Dim numbers each
};

/// Total force of a load at that time, along its direction (N); 0 of a prescribed motion.
template <int Dim>
double total_applied(const Model<Dim>& model, const Load& load, double time);

}  // namespace hibi
