#include "elasticity/frequency.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "algebra/cholesky.hpp"
#include "elasticity/tangent.hpp"

namespace hibi {

namespace {

constexpr int most_iterations = 300;
/// The estimate rises from below: it is taken when it has come to rest over so many iterations.
constexpr int iterations_at_rest = 8;
constexpr double at_rest = 1e-7;
/// Displacements by which the forces are tried out, in spacings: small enough that these are linear to 1e-7,
/// large enough that rounding stays below 1e-9.
constexpr double amplitude = 1e-7;

/// sqrt(m) u, and sqrt(I) theta where there is one: the operator is then symmetric, whatever the masses.
template <int Dim>
struct Unknowns {
    std::vector<Vec<Dim>> moved;
    std::vector<double> turned;

    double dot(const Unknowns& other) const {
        return parallel_sum<double>(static_cast<int>(moved.size()), [&](int begin, int end) {
            double sum = 0;
            for (int i = begin; i < end; ++i)
                sum += moved[i].dot(other.moved[i]) + (turned.empty() ? 0 : turned[i] * other.turned[i]);
            return sum;
        });
    }
    /// Becomes scale * (itself - a first - b second).
    void combine(double scale, double a, const Unknowns& first, double b, const Unknowns& second) {
        parallel_for(static_cast<int>(moved.size()), [&](int begin, int end) {
            for (int i = begin; i < end; ++i)
                moved[i] = scale * (moved[i] - a * first.moved[i] - b * second.moved[i]);
            if (turned.empty()) return;
            for (int i = begin; i < end; ++i)
                turned[i] = scale * (turned[i] - a * first.turned[i] - b * second.turned[i]);
        });
    }
};

/// M^-1/2 K M^-1/2 times `from`, as the difference that a small displacement makes to the forces at rest.
template <int Dim>
void apply(const Model<Dim>& model, ElasticLaw<Dim>& law, State<Dim>& state, const Unknowns<Dim>& from,
           Unknowns<Dim>& to) {
    struct Largest {
        double value = 0;
        void operator+=(const Largest& other) { value = std::max(value, other.value); }
    };
    const Particles<Dim>& particles = model.particles;
    const int n = particles.count();
    const bool spins = state.has_spin();
    const double largest =  // of u over spacing, to scale by
        parallel_sum<Largest>(n, [&](int begin, int end) {
            Largest part;
            for (int i = begin; i < end; ++i) {
                part += {from.moved[i].cwiseAbs().maxCoeff() /
                         (std::sqrt(particles.mass[i]) * particles.spacing[i])};
                if (spins) part += {std::abs(from.turned[i]) / std::sqrt(law.spin_inertia(i))};
            }
            return part;
        }).value;
    const double scale = amplitude / largest;
    parallel_for(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            state.displacement[i] = scale / std::sqrt(particles.mass[i]) * from.moved[i];
            if (spins) state.angle[i] = scale / std::sqrt(law.spin_inertia(i)) * from.turned[i];
        }
    });
    law.forces(state);
    parallel_for(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            to.moved[i] = -1 / (scale * std::sqrt(particles.mass[i])) * state.force[i];
            if (spins) to.turned[i] = -1 / (scale * std::sqrt(law.spin_inertia(i))) * state.torque[i];
        }
    });
}

}  // namespace

template <int Dim>
double highest_frequency(const Model<Dim>& model, ElasticLaw<Dim>& law) {
    const Particles<Dim>& particles = model.particles;
    const int n = particles.count();
    State<Dim> state = initial_state(model);
    law.start(state, std::vector<std::array<bool, 3>>(n));
    const bool spins = state.has_spin();
    Unknowns<Dim> last, now, next;
    for (Unknowns<Dim>* of : {&last, &now, &next}) {
        of->moved.assign(n, Vec<Dim>::Zero());
        of->turned.assign(spins ? n : 0, 0.0);
    }
    for (int i = 0; i < n; ++i) {
        for (int a = 0; a < Dim; ++a) now.moved[i][a] = unit_random(mix_bits(Dim * i + a)) - 0.5;
        if (spins) now.turned[i] = unit_random(mix_bits(~i)) - 0.5;
    }
    now.combine(1 / std::sqrt(now.dot(now)), 0, now, 0, now);

    // Lanczos: the largest eigenvalue of the tridiagonal matrix of `diagonal` and `beside` rises to that of
    // K.
    std::vector<double> diagonal, beside, estimates;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        apply(model, law, state, now, next);
        diagonal.push_back(next.dot(now));
        next.combine(1, diagonal.back(), now, beside.empty() ? 0 : beside.back(), last);
        const double norm = std::sqrt(next.dot(next));

        const auto size = static_cast<Eigen::Index>(diagonal.size());
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen;
        eigen.computeFromTridiagonal(Eigen::VectorXd::Map(diagonal.data(), size),
                                     Eigen::VectorXd::Map(beside.data(), size - 1), Eigen::EigenvaluesOnly);
        estimates.push_back(eigen.eigenvalues().maxCoeff());
        const double estimate = estimates.back();
        if (!(norm > 1e-6 * estimate)) break;  // nothing is left to be found
        if (iteration >= iterations_at_rest &&
            estimate - estimates[iteration - iterations_at_rest] < at_rest * estimate)
            break;
        next.combine(1 / norm, 0, next, 0, next);
        beside.push_back(norm);
        std::swap(last, now);
        std::swap(now, next);
    }
    const double eigenvalue = estimates.back();
    if (!(eigenvalue > 0)) {  // no bonds, no frequency: as if a wave had to cross a particle in a step
        double fastest = 0;
        for (int i = 0; i < n; ++i) {
            const Material& m = model.materials[particles.material[i]];
            fastest = std::max(fastest, std::sqrt(m.youngs_modulus / m.density) / particles.spacing[i]);
        }
        return 2 * fastest;
    }
    assert(spins || n > 5000 ||
           std::sqrt(eigenvalue) <= frequency_bound(model, initial_state(model)) * (1 + 1e-9));
    return std::sqrt(eigenvalue);
}

template <int Dim>
double first_frequency(const Model<Dim>& model, const std::vector<std::array<bool, 3>>& held) {
    const int n = model.particles.count();
    Tangent<Dim> tangent(model, initial_state(model));
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
    // The last digits are those of the BLAS, which differs between processors.
    return static_cast<float>(std::sqrt(eigenvalue));
}

template <int Dim>
double stable_time_step(const Model<Dim>& model, Elasticity elasticity) {
    const std::unique_ptr<ElasticLaw<Dim>> law = make_elastic_law<Dim>(model, elasticity);
    return 2 / highest_frequency(model, *law);
}

template double highest_frequency<2>(const Model<2>&, ElasticLaw<2>&);
template double first_frequency<2>(const Model<2>&, const std::vector<std::array<bool, 3>>&);
template double stable_time_step<2>(const Model<2>&, Elasticity);

}  // namespace hibi
