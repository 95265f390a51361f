#include "elasticity/dilatation.hpp"

namespace hibi {

namespace {

/// Sine squared of the angle below which two bonds are parallel.
constexpr double parallel = 1e-9;

bool on_a_line(const Model<2>& model, int i) {
    const std::vector<Vec<2>>& X = model.particles.reference_position;
    const Bonds& bonds = model.bonds;
    Vec<2> first = Vec<2>::Zero();
    for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
        const Vec<2> r0 = X[bonds.other(bonds.bonds_of[k], i)] - X[i];
        if (k == bonds.start[i]) first = r0;
        const double across = first.x() * r0.y() - first.y() * r0.x();
        if (across * across > parallel * first.squaredNorm() * r0.squaredNorm()) return false;
    }
    return true;
}

}  // namespace

template <int Dim>
std::vector<double> dilatation_moduli(const Model<Dim>& model) {
    std::vector<double> moduli;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Material& material = model.materials[model.particles.material[i]];
        const double lambda = lame_lambda(material, model.assumption), two_mu = 2 * shear_modulus(material);
        moduli.push_back(on_a_line(model, i) ? two_mu * lambda / (two_mu + lambda) : lambda);
    }
    return moduli;
}

template std::vector<double> dilatation_moduli<2>(const Model<2>&);

}  // namespace hibi
