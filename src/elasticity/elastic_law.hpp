#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "model/state.hpp"

namespace hibi {

/// "moment-matched": weights corrected per particle, rotation from the polar decomposition. "thesis": Ando's
/// own variant, plain weights and an independent angle per particle.
enum class Elasticity { moment_matched, thesis };

/// Bond strain (|r| - |r0|) / |r0| without loss of digits; du = u_j - u_i. The same bits from both ends.
template <int Dim>
double bond_strain(const Vec<Dim>& r0, const Vec<Dim>& du) {
    const double rest = r0.norm();
    return (2 * r0.dot(du) + du.squaredNorm()) / (rest * (rest + (r0 + du).norm()));
}

/// Of some bonds' strains the one that is largest in size, found without a root for each.
struct LargestStrain {
    double longest = 0, shortest = 0;  ///< (L^2 - L0^2) / L0^2 [-]

    void look(double growth) {
        longest = std::max(longest, growth);
        shortest = std::min(shortest, growth);
    }
    /// Signed; infinite at worst [-].
    double strain() const {
        const double tension = strain_of(longest), compression = strain_of(shortest);
        return tension >= -compression ? tension : compression;
    }

 private:
    static double strain_of(double growth) {
        const double ratio = std::sqrt(1 + growth);
        return growth < 1 ? growth / (1 + ratio) : ratio - 1;
    }
};

/// Bounds of a bond in the form the hot loop compares, (L^2 - L0^2) / L0^2: it breaks above `upper` or below
/// `lower`.
struct BreakLimits {
    std::vector<double> upper{}, lower{};  ///< per bond; infinite where it cannot break. Empty: nothing can
};

/// What one particle feels, for energies, pictures and files.
template <int Dim>
struct LocalState {
    double energy = 0;       ///< (J)
    Mat<Dim> stress{};       ///< Cauchy stress of the surviving bonds (Pa), current frame
    double dilatation = 0;   ///< D_i [-]
    double bond_strain = 0;  ///< of the surviving bond of largest strain in size, signed [-]
};

/// Called for particles [begin, end), a block of parallel_for's.
using FinishBlock = std::function<void(int begin, int end)>;

template <int Dim>
class Tangent;

/// An elastic law of a model: one discrete energy of the displacements (and angles, where it has them) and
/// its exact forces. Virtual once per step; the loops over the bonds are inside. The model must outlive it.
template <int Dim>
class ElasticLaw {
 public:
    virtual ~ElasticLaw() = default;

    /// Gives the state, that of the start, what the law keeps in it: angles, where it has them. `held[i][a]`:
    /// component a of particle i does not move.
    virtual void start(State<Dim>&, const std::vector<std::array<bool, 3>>& /*held*/) const {}
    /// Inertia of the angle of a particle, where it has one (kg m^2).
    virtual double spin_inertia(int /*particle*/) const { return 0; }

    /// The displacements of particles [begin, end) have changed since the last call.
    virtual void update_displacements(const State<Dim>& state, int begin, int end) = 0;
    /// Overwrites state.force, and state.torque where there is one, with -dU/du (N) and -dU/dtheta (N m).
    /// `finish_block`, if given, is called for every block of particles once its forces stand; it must leave
    /// displacements alone. Returns in which blocks, rising, bonds may be beyond their limits: of such a bond,
    /// the block of its first particle.
    virtual std::vector<int> sum_forces(State<Dim>& state, const FinishBlock& finish_block = {}) = 0;
    /// Both.
    std::vector<int> forces(State<Dim>& state);
    /// The forces of some blocks of particles alone (rising): after breaks, for those in which the ends of
    /// the broken bonds lie and their neighbours. All others must stand.
    virtual void recompute_forces(State<Dim>& state, const std::vector<int>& blocks,
                                  const FinishBlock& finish_block) = 0;

    virtual LocalState<Dim> local(const State<Dim>& state, int particle) const = 0;
    /// Of particles [begin, end), a block of parallel_for's; for displacements that it has been told of.
    virtual std::vector<LocalState<Dim>> local(const State<Dim>& state, int begin, int end) const = 0;
    /// Sum of the particles' energies (J).
    virtual double energy(const State<Dim>& state) const = 0;
    /// The bond carries nothing from now on; the survivors keep their weights. The order in which bonds are
    /// removed leaves no trace in any bit.
    virtual void remove(int bond) = 0;

    /// The second derivative of its energy, linearised about the state; null where the law has none, and so
    /// no statics.
    virtual std::unique_ptr<Tangent<Dim>> tangent(const State<Dim>& state) const = 0;
    /// What its forces are called in the list of stages.
    virtual std::string name() const = 0;
};

/// The law that `elasticity` names, of the unbroken model. Without limits no bond is ever beyond one.
template <int Dim>
std::unique_ptr<ElasticLaw<Dim>> make_elastic_law(const Model<Dim>& model, Elasticity elasticity,
                                                  const BreakLimits& limits = {});
template <>
std::unique_ptr<ElasticLaw<2>> make_elastic_law<2>(const Model<2>& model, Elasticity elasticity,
                                                   const BreakLimits& limits);

/// The same, without the bonds that are broken in a state.
template <int Dim>
std::unique_ptr<ElasticLaw<Dim>> make_elastic_law(const Model<Dim>& model, Elasticity elasticity,
                                                  const State<Dim>& state, const BreakLimits& limits = {}) {
    std::unique_ptr<ElasticLaw<Dim>> law = make_elastic_law<Dim>(model, elasticity, limits);
    for (int b = 0; b < model.bonds.count(); ++b)
        if (!state.is_intact(b)) law->remove(b);
    return law;
}

}  // namespace hibi
