#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace hibi {

/// Where the energy of a run is and where it went (J). All at one time, positions and velocities in step.
struct Energies {
    double kinetic = 0, elastic = 0, contact = 0;
    double damped = 0;  ///< taken out by damping so far; in statics what is lost on the way to equilibrium
    double released =
        0;  ///< elastic energy of bonds at the moment they broke; a single break may be slightly negative
    double work =
        0;  ///< done by loads, prescribed motion and gravity so far, plus the initial kinetic energy
    double sum() const { return kinetic + elastic + contact + damped + released; }

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("kinetic", self.kinetic);
        visit("elastic", self.elastic);
        visit("contact", self.contact);
        visit("damped", self.damped);
        visit("released", self.released);
        visit("work", self.work);
    }
};

/// Numbers that an interaction, or a way of moving, keeps from one step to the next.
struct Memory {
    std::string name;
    std::vector<double> values;  ///< flags are 0 or 1

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("name", self.name);
        visit("values", self.values);
    }
};

/// Everything that a step reads and an earlier step has changed. A model and its State determine the rest of
/// a run to the last bit: whatever else a simulation holds is rebuilt from the two.
template <int Dim>
struct State {
    double time = 0;  ///< (s)
    std::int64_t step = 0;
    // Per particle.
    std::vector<Vec<Dim>> displacement;  ///< u = x - X (m): strains of 1e-9 keep their digits
    std::vector<Vec<Dim>> velocity;      ///< v (m/s)
    std::vector<Vec<Dim>> force;         ///< sum of all terms at the current time (N)
    // Rotation of each particle as an unknown of its own: thesis variant only, else empty.
    std::vector<double> angle;             ///< (rad)
    std::vector<double> angular_velocity;  ///< (rad/s)
    std::vector<double> torque;            ///< (N m)
    // Per bond.
    std::vector<double> broken_at;  ///< time of failure (s), or Bonds::intact
    // Of all of it.
    int broken = 0;                 ///< number of broken bonds
    std::vector<char> released;     ///< per load: has it ended?
    double damping_rate = 0;        ///< c (1/s); 0 when undamped, or no longer damped
    Energies energies;              ///< the accounts; `elastic` is counted on demand
    std::vector<Memory> memories;   ///< of the interactions and the way of moving, see remember()
    std::string failure;            ///< says why the run cannot go on; empty: it can
    std::string collapse;           ///< the same of statics: no equilibrium was found beyond this load
    std::string instability;        ///< statics: the first equilibrium that became unstable; or empty

    bool is_intact(int bond) const { return broken_at[bond] == Bonds::intact; }
    bool has_spin() const { return !angle.empty(); }

    /// Adds a memory and returns its handle. To be called in the same order for the same scene: a state can
    /// then be handed from one simulation to another.
    int remember(std::string name, std::size_t size, double value = 0) {
        memories.push_back({std::move(name), std::vector<double>(size, value)});
        return static_cast<int>(memories.size()) - 1;
    }
    std::vector<double>& memory(int handle) { return memories[handle].values; }
    const std::vector<double>& memory(int handle) const { return memories[handle].values; }

    /// The one list of fields: hash, save, load and compare walk it.
    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("time", self.time);
        visit("step", self.step);
        visit("displacement", self.displacement);
        visit("velocity", self.velocity);
        visit("force", self.force);
        visit("angle", self.angle);
        visit("angular_velocity", self.angular_velocity);
        visit("torque", self.torque);
        visit("broken_at", self.broken_at);
        visit("broken", self.broken);
        visit("released", self.released);
        visit("damping_rate", self.damping_rate);
        visit("energies", self.energies);
        visit("memories", self.memories);
        visit("failure", self.failure);
        visit("collapse", self.collapse);
        visit("instability", self.instability);
    }
};

/// Of an unloaded body that moves with its initial velocity; nothing is broken.
template <int Dim>
State<Dim> initial_state(const Model<Dim>& model);

/// x = X + u of a particle (m).
template <int Dim>
Vec<Dim> position(const Model<Dim>& model, const State<Dim>& state, int i) {
    return model.particles.reference_position[i] + state.displacement[i];
}

}  // namespace hibi
