#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "model/model.hpp"
#include "physics/physics.hpp"
#include "physics/weights.hpp"

namespace hibi {

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

/// An elastic law: one discrete energy of the model's displacements (and angles, where it has them) and its
/// exact forces. Virtual once per step; the loops over the bonds are inside.
template <int Dim>
class ElasticLaw {
 public:
    virtual ~ElasticLaw() = default;

    /// The displacements of particles [begin, end) have changed since the last call.
    virtual void displaced(const Model<Dim>& model, int begin, int end) = 0;
    /// Overwrites particles.force, and spin.torque where there is one, with -dU/du (N) and -dU/dtheta (N m).
    /// `then`, if given, is called for every block of particles (of parallel_block each) once its forces
    /// stand; it must leave displacements alone. Returns in which blocks, rising, bonds may be beyond their
    /// limits: of such a bond, the block of its first particle.
    virtual std::vector<int> sum_forces(Model<Dim>& model,
                                        const std::function<void(int begin, int end)>& then = {}) = 0;
    /// Both.
    std::vector<int> forces(Model<Dim>& model);
    /// The forces of some blocks of particles alone (rising): after breaks, for those in which the ends of
    /// the broken bonds lie and their neighbours. All others must stand.
    virtual void renew(Model<Dim>& model, const std::vector<int>& blocks,
                       const std::function<void(int begin, int end)>& then) = 0;

    virtual LocalState<Dim> local(const Model<Dim>& model, int particle) const = 0;
    /// Of particles [begin, end), a block of parallel_for's; for displacements that it has been told of.
    virtual std::vector<LocalState<Dim>> local(const Model<Dim>& model, int begin, int end) const = 0;
    /// Sum of the particles' energies (J).
    virtual double energy(const Model<Dim>& model) const = 0;
    /// The bond carries nothing from now on; the survivors keep their weights.
    virtual void remove(const Bonds& bonds, int bond) = 0;
};

/// The law that `elasticity` names, on the reference state of the model; bonds already broken carry nothing.
/// The thesis variant uses the model's `spin`, which must exist.
/// Without limits no bond is ever beyond one.
template <int Dim>
std::unique_ptr<ElasticLaw<Dim>> make_elastic_law(const Model<Dim>& model, Elasticity elasticity,
                                                  const BreakLimits& limits = {});
template <>
std::unique_ptr<ElasticLaw<2>> make_elastic_law<2>(const Model<2>& model, Elasticity elasticity,
                                                   const BreakLimits& limits);

/// At rest, inertia m l0^2 / 6.
template <int Dim>
Spin make_spin(const Model<Dim>& model);

}  // namespace hibi
