#pragma once
#include <string>
#include <utility>
#include <vector>

#include "model/bonds.hpp"
#include "model/fill.hpp"
#include "model/material.hpp"
#include "model/particles.hpp"

namespace hibi {

/// A cut made before the run: no bond crosses it, or touches it, its end points included.
template <int Dim>
struct Notch {
    std::string name;
    std::vector<Vec<Dim>> points;  ///< polyline (m)
    int body = -1;                 ///< the only body it cuts, or -1 for all
};

template <int Dim>
struct Body {
    std::string name;
    Shape<Dim> shape;
    double spacing = 0;  ///< l0 (m)
    Lattice lattice{};
    int material = 0;  ///< index into Model::materials
    std::vector<int>
        bonded_to{};         ///< bodies with a lower index and the same spacing that bonds reach across to
    int begin = 0, end = 0;  ///< its particles, once filled
    std::vector<Vec<Dim>> undisturbed{};  ///< where the particles were before the jitter; empty without one
};

/// What never changes in a run: particles, bonds and materials. What changes is in State.
template <int Dim>
struct Model {
    Particles<Dim> particles;
    Bonds bonds;
    BondVectors<Dim> bond_vectors{};
    std::vector<Material> materials;
    std::vector<Body<Dim>> bodies;
    Assumption assumption = Assumption::plane_stress;
    double thickness = 1;     ///< of a 2-D body (m)
    double influence = 2.1;   ///< r_e / l0 [-]
    int bonds_cut = 0;        ///< removed by notches before the run
    int bonds_over_gaps = 0;  ///< not made, for they would cross empty space

    /// Centre of the cell that a particle stands for: where it is but for jitter.
    const Vec<Dim>& cell_centre(int i) const {
        const Body<Dim>& body = bodies[particles.body[i]];
        return body.undisturbed.empty() ? particles.reference_position[i] : body.undisturbed[i - body.begin];
    }
};

/// Appends the particles of a body at rest, and sets its begin and end. A cell that an earlier body has
/// already, centre on centre on a side of both, is left to that one.
template <int Dim>
void add_body(Model<Dim>& model, Body<Dim> body);

/// Finds all bonds: pairs of one body, or of bodies bonded to each other, nearer than influence * l0 in the
/// reference configuration, with matter all the way between them (Matter), and not cut by a notch. Replaces
/// model.bonds and model.bond_vectors. Returns, for every notch, the number of bonds it cut.
template <int Dim>
std::vector<int> connect(Model<Dim>& model, const std::vector<Notch<Dim>>& notches);

/// Pairs (first < second) of points nearer than `radius`, sorted. A grid of cells; linear in the number of
/// points.
template <int Dim>
std::vector<std::pair<int, int>> neighbours(const std::vector<Vec<Dim>>& points, double radius);

}  // namespace hibi
