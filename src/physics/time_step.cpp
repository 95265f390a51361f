#include "physics/time_step.hpp"

#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "physics/cholesky.hpp"
#include "physics/tangent.hpp"

namespace hibi {

namespace {

/// The estimate rises from below: it is taken when it has come to rest.
constexpr int least_iterations = 60, most_iterations = 1000;
constexpr double at_rest = 1e-7;
/// Displacements of the power iteration, in spacings: small enough that the forces are linear to 1e-7, large
/// enough that rounding stays below 1e-9.
constexpr double amplitude = 1e-7;

}  // namespace

template <int Dim>
double highest_frequency(Model<Dim>& model, ElasticLaw<Dim>& law) {
    Particles<Dim>& particles = model.particles;
    const int n = particles.count();
    // The unknowns are y = sqrt(m) u (and sqrt(I) theta): the operator is then symmetric, whatever the
    // masses.
    std::vector<Vec<Dim>> y(n);
    std::vector<double> turn(model.spin ? n : 0);
    for (int i = 0; i < n; ++i) {
        for (int a = 0; a < Dim; ++a) y[i][a] = unit_random(mix_bits(Dim * i + a)) - 0.5;
        if (model.spin) turn[i] = unit_random(mix_bits(~i)) - 0.5;
    }
    const auto norm = [&] {
        return std::sqrt(parallel_sum<double>(n, [&](int begin, int end) {
            double sum = 0;
            for (int i = begin; i < end; ++i)
                sum += y[i].squaredNorm() + (model.spin ? turn[i] * turn[i] : 0);
            return sum;
        }));
    };

    double eigenvalue = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        double largest = 0;  // of u over spacing, to scale by
        for (int i = 0; i < n; ++i) {
            largest = std::max(
                largest, y[i].cwiseAbs().maxCoeff() / (std::sqrt(particles.mass[i]) * particles.spacing[i]));
            if (model.spin)
                largest = std::max(largest, std::abs(turn[i]) / std::sqrt(model.spin->inertia[i]));
        }
        if (!(largest > 0)) break;  // no bonds at all
        const double scale = amplitude / largest;
        parallel_for(n, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                particles.displacement[i] = scale / std::sqrt(particles.mass[i]) * y[i];
                if (model.spin) model.spin->angle[i] = scale / std::sqrt(model.spin->inertia[i]) * turn[i];
            }
        });
        law.forces(model);
        const double before = norm();
        parallel_for(n, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) {
                y[i] = -1 / (before * scale * std::sqrt(particles.mass[i])) * particles.force[i];
                if (model.spin)
                    turn[i] =
                        -1 / (before * scale * std::sqrt(model.spin->inertia[i])) * model.spin->torque[i];
            }
        });
        // |K y| / |y| rises towards the largest eigenvalue and is nearer to it than the Rayleigh quotient is.
        const double last = eigenvalue;
        eigenvalue = norm();
        if (iteration >= least_iterations && eigenvalue - last < at_rest * eigenvalue) break;
    }
    for (int i = 0; i < n; ++i) {
        particles.displacement[i].setZero();
        particles.force[i].setZero();
        if (model.spin) model.spin->angle[i] = model.spin->torque[i] = 0;
    }
    if (!(eigenvalue > 0)) {  // no bonds, no frequency: as if a wave had to cross a particle in a step
        double fastest = 0;
        for (int i = 0; i < n; ++i) {
            const Material& m = model.materials[particles.material[i]];
            fastest = std::max(fastest, std::sqrt(m.youngs_modulus / m.density) / particles.spacing[i]);
        }
        return 2 * fastest;
    }
    assert(model.spin || n > 5000 || std::sqrt(eigenvalue) <= frequency_bound(model) * (1 + 1e-9));
    return std::sqrt(eigenvalue);
}

template <int Dim>
double first_frequency(const Model<Dim>& model, const std::vector<std::array<bool, 3>>& held) {
    const int n = model.particles.count();
    Tangent<Dim> tangent(model);
    Eigen::SparseMatrix<double> K = tangent.assemble(held);
    for (int column = 0; column < K.outerSize(); ++column)
        for (Eigen::SparseMatrix<double>::InnerIterator at(K, column); at; ++at)
            at.valueRef() /=
                std::sqrt(model.particles.mass[column / Dim] * model.particles.mass[at.row() / Dim]);
    Eigen::VectorXd y(Dim * n);
    for (int k = 0; k < Dim * n; ++k) y[k] = held[k / Dim][k % Dim] ? 0 : unit_random(mix_bits(k)) - 0.5;
    if (y.isZero(0)) throw std::runtime_error("every particle is held: there is no first mode to damp");
    y.normalize();

    Cholesky cholesky(K);
    if (!cholesky.factorise(K) || cholesky.weakest(K).ratio < singular_pivot)
        throw std::runtime_error("a body can move freely: it has no first mode to damp by a ratio");
    Eigen::VectorXd next;
    double eigenvalue = 0;
    for (int iteration = 0; iteration < 200; ++iteration) {
        cholesky.solve(y, next);
        const double estimate = 1 / y.dot(next);
        y = next.normalized();
        if (std::abs(estimate - eigenvalue) < 1e-10 * estimate) break;
        eigenvalue = estimate;
    }
    return std::sqrt(eigenvalue);
}

template <int Dim>
double stable_time_step(const Model<Dim>& model, Elasticity elasticity) {
    Model<Dim> copy = model;
    if (elasticity == Elasticity::thesis) copy.spin = make_spin(copy);
    const std::unique_ptr<ElasticLaw<Dim>> law = make_elastic_law<Dim>(copy, elasticity);
    return 2 / highest_frequency(copy, *law);
}

template double highest_frequency<2>(Model<2>&, ElasticLaw<2>&);
template double first_frequency<2>(const Model<2>&, const std::vector<std::array<bool, 3>>&);
template double stable_time_step<2>(const Model<2>&, Elasticity);

}  // namespace hibi
