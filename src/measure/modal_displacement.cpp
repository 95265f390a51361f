#include "measure/modal_displacement.hpp"

#include "elasticity/thesis.hpp"

namespace hibi {

ModalDisplacement::ModalDisplacement(const Simulation& simulation) {
    in_its_dimension(simulation, [&]<int Dim>(const SimulationIn<Dim>& s) {
        for (int i = 0; i < s.particle_count(); ++i) {
            const Vec<Dim>& v = s.state().velocity[i];
            const Vec<Dim> momentum = s.model().particles.mass[i] * v;
            momentum_.push_back(to_3d<Dim>(momentum));
            scale_ += momentum.dot(v);
        }
    });
}

double ModalDisplacement::operator()(const Simulation& simulation) const {
    return in_its_dimension(simulation, [&]<int Dim>(const SimulationIn<Dim>& s) {
        double sum = 0;
        for (int i = 0; i < s.particle_count(); ++i)
            sum += momentum_[i].head<Dim>().dot(s.state().displacement[i]);
        return sum / scale_;
    });
}

std::optional<double> period_of(std::span<const double> times, std::span<const double> displacement) {
    int passages = 0;
    double last = 0;
    for (std::size_t k = 1; k < displacement.size(); ++k) {
        if (displacement[k - 1] == 0 || (displacement[k - 1] > 0) == (displacement[k] > 0)) continue;
        ++passages;
        last = times[k - 1] + (times[k] - times[k - 1]) * displacement[k - 1] / (displacement[k - 1] - displacement[k]);
    }
    if (passages == 0) return {};
    return 2 * last / passages;
}

double angular_momentum(const Simulation& simulation) {
    const auto& s = dynamic_cast<const SimulationIn<2>&>(simulation);
    double sum = 0;
    for (int i = 0; i < s.particle_count(); ++i) {
        const Vec<2> x = position(s.model(), s.state(), i);
        const Vec<2> p = s.model().particles.mass[i] * s.state().velocity[i];
        sum += x.x() * p.y() - x.y() * p.x();
        if (s.state().has_spin()) sum += spin_inertia(s.model().particles, i) * s.state().angular_velocity[i];
    }
    return sum;
}

}  // namespace hibi
