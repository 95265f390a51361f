#pragma once
#include <memory>
#include <vector>

#include "results/snapshot.hpp"
#include "simulation/simulation.hpp"

namespace hibi {

/// Positions, velocities and broken bonds as they are now, with everything derived from them.
Snapshot take_snapshot(const Simulation& simulation);

/// What a snapshot is derived from. Copying it takes far less time than deriving a snapshot.
struct Motion {
    double time = 0;  ///< (s)
    std::int64_t step = 0;
    std::vector<double> displacement, velocity;  ///< all components, particle by particle (m), (m/s)
    std::vector<double> angle;                   ///< thesis variant only, else empty (rad)

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("time", self.time);
        visit("step", self.step);
        visit("displacement", self.displacement);
        visit("velocity", self.velocity);
        visit("angle", self.angle);
    }
};
Motion copy_motion(const Simulation& simulation);

/// The body of a simulation as it was before anything broke: gives the snapshots of moments that have passed.
class UnbrokenBody {
 public:
    /// The simulation must outlive it.
    explicit UnbrokenBody(const Simulation& simulation);
    ~UnbrokenBody();
    /// The same bits as take_snapshot would have given then, if no bond was broken yet.
    Snapshot snapshot(const Motion& motion);

 private:
    template <int Dim>
    struct In;
    struct Any;
    std::unique_ptr<Any> body_;
};

}  // namespace hibi
