#pragma once
#include "physics/interaction.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Loads that drive particles: displacements and velocities over time. The force that this takes, the
/// reaction, is what is read as the load.
template <int Dim>
class PrescribedMotion final : public Interaction<Dim> {
 public:
    PrescribedMotion(const Model<Dim>& model, const Physics& physics, State<Dim>& state,
                     ElasticForces<Dim>& elastic);
    static bool exists(const Physics& physics);

    StageNames stages() const override { return {.move = "prescribed motion"}; }
    void start(State<Dim>& state) override;
    void begin_step(State<Dim>& state) override;
    /// Overwrites what kick and drift did to driven components. Until finish_motion their velocity is the
    /// mean over the step, so that velocity * step is everybody's movement.
    void move(State<Dim>& state, double step) override;
    void finish_motion(State<Dim>& state) override;
    void add_static_loads(const State<Dim>& state, double time, double share,
                          StaticLoads<Dim>& loads) const override;
    void take_static_loads(State<Dim>& state, double time, double share) override;
    void add_static_work(const State<Dim>& before, State<Dim>& now) const override;
    double load(const State<Dim>& state, int load) const override;

 private:
    /// A particle component moved by a load.
    struct Driven {
        int load = 0, particle = 0, axis = 0;
    };
    double value_at(const Driven& d, double time) const;

    const Model<Dim>& model_;
    const std::vector<Load>& loads_;
    ElasticForces<Dim>& elastic_;
    std::vector<Driven> driven_;
    int displacement_ = 0, velocity_ = 0;        ///< memories: prescribed so far (m), (m/s)
    std::vector<double> moved_, force_before_;  ///< in this step (m); total force before it (N)
};

}  // namespace hibi
