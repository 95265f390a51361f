#include "measure/swing.hpp"

namespace hibi {

template <int Dim>
Swing<Dim>::Swing(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    momentum_.resize(particles.count());
    for (int i = 0; i < particles.count(); ++i) {
        momentum_[i] = particles.mass[i] * particles.velocity[i];
        scale_ += momentum_[i].dot(particles.velocity[i]);
    }
}

template <int Dim>
double Swing<Dim>::operator()(const Model<Dim>& model) const {
    double sum = 0;
    for (int i = 0; i < model.particles.count(); ++i)
        sum += momentum_[i].dot(model.particles.displacement[i]);
    return sum / scale_;
}

std::optional<double> period_of(std::span<const double> times, std::span<const double> swing) {
    int passages = 0;
    double last = 0;
    for (std::size_t k = 1; k < swing.size(); ++k) {
        if (swing[k - 1] == 0 || (swing[k - 1] > 0) == (swing[k] > 0)) continue;
        ++passages;
        last = times[k - 1] + (times[k] - times[k - 1]) * swing[k - 1] / (swing[k - 1] - swing[k]);
    }
    if (passages == 0) return {};
    return 2 * last / passages;
}

double angular_momentum(const Model<2>& model) {
    const Particles<2>& particles = model.particles;
    double sum = 0;
    for (int i = 0; i < particles.count(); ++i) {
        const Vec<2> x = particles.position(i), p = particles.mass[i] * particles.velocity[i];
        sum += x.x() * p.y() - x.y() * p.x();
        if (model.spin) sum += model.spin->inertia[i] * model.spin->velocity[i];
    }
    return sum;
}

template class Swing<2>;

}  // namespace hibi
