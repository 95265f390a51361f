#include "scene/build_supports.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "loads/supports.hpp"
#include "model/intact_bonds.hpp"

namespace hibi {

void check_conflicts(const Built<2>& built, Problems& problems) {
    const int n = built.model.particles.count();
    std::array<std::vector<const std::string*>, 2> owner{std::vector<const std::string*>(n),
                                                         std::vector<const std::string*>(n)};
    for (const Hold& hold : built.physics.holds)
        for (const int i : hold.particles)
            for (int axis = 0; axis < 2; ++axis)
                if (hold.axes[axis]) owner[axis][i] = &hold.name;
    for (std::size_t l = 0; l < built.physics.loads.size(); ++l) {
        const Load& load = built.physics.loads[l];
        for (int axis = 0; axis < 2; ++axis)
            for (const int i : load.particles) {
                if (!load.driven[axis]) continue;
                if (owner[axis][i]) {
                    const Vec<2>& X = built.model.particles.reference_position[i];
                    problems.add(fmt::format("load/{}", l),
                                 fmt::format("[[load]]: \"{}\" and \"{}\" both prescribe the {} of the "
                                             "particle at ({:g} m, {:g} m)",
                                             load.name, *owner[axis][i], axis == 0 ? 'x' : 'y', X.x(), X.y()),
                                 "select apart, or make a direction \"free\"");
                    return;
                }
                owner[axis][i] = &load.name;
            }
    }
}

std::optional<int> free_particle(const Built<2>& built) {
    const Particles<2>& particles = built.model.particles;
    const Bonds& bonds = built.model.bonds;
    const int n = particles.count();
    const std::vector<int> part = connected_parts(bonds, [](int) { return true; });
    const HeldComponents held = held_or_driven(n, built.physics);

    std::vector<Vec<2>> centre(n, Vec<2>::Zero());
    std::vector<int> count(n, 0);
    for (int i = 0; i < n; ++i) {
        centre[part[i]] += particles.reference_position[i];
        ++count[part[i]];
    }
    // Each held component forbids one combination of the two translations and the rotation; a rotation is
    // measured by what it moves at one spacing from the centre of the part.
    std::vector<Mat<3>> forbidden(n, Mat<3>::Zero());
    for (int i = 0; i < n; ++i) {
        const int r = part[i];
        const Vec<2> arm = (particles.reference_position[i] - centre[r] / count[r]) / particles.spacing[i];
        for (int axis = 0; axis < 2; ++axis) {
            if (!held[i][axis]) continue;
            const Vec3 row = axis == 0 ? Vec3(1, 0, -arm.y()) : Vec3(0, 1, arm.x());
            forbidden[r] += row * row.transpose();
        }
    }
    for (int i = 0; i < n; ++i) {
        if (part[i] != i) continue;
        const Vec3 eigen =
            Eigen::SelfAdjointEigenSolver<Mat<3>>(forbidden[i], Eigen::EigenvaluesOnly).eigenvalues();
        if (!(eigen.minCoeff() > 1e-9 * std::max(1.0, eigen.maxCoeff()))) return i;
    }
    return {};
}

}  // namespace hibi
