#include "loads/supports.hpp"

#include "model/intact_bonds.hpp"

namespace hibi {

namespace {

void add(HeldComponents& held, const std::vector<int>& particles, const std::array<bool, 3>& axes) {
    for (const int i : particles)
        for (int a = 0; a < 3; ++a) held[i][a] = held[i][a] || axes[a];
}

}  // namespace

HeldComponents held_by_supports(int particles, const Physics& physics) {
    HeldComponents held(particles, std::array<bool, 3>{});
    for (const Hold& hold : physics.holds) add(held, hold.particles, hold.axes);
    return held;
}

HeldComponents held_or_driven(int particles, const Physics& physics, const std::vector<char>& released) {
    HeldComponents held = held_by_supports(particles, physics);
    for (std::size_t l = 0; l < physics.loads.size(); ++l)
        if (released.empty() || !released[l]) add(held, physics.loads[l].particles, physics.loads[l].driven);
    return held;
}

template <int Dim>
std::vector<char> tied_to_support(const Bonds& bonds, const State<Dim>& state, const HeldComponents& held) {
    std::vector<int> begin;
    for (std::size_t i = 0; i < held.size(); ++i)
        if (held[i][0] || held[i][1] || held[i][2]) begin.push_back(static_cast<int>(i));
    std::vector<char> tied(held.size(), 0);
    walk_along_intact_bonds(bonds, state, begin, [&](int i) {
        tied[i] = 1;
        return true;
    });
    return tied;
}

template std::vector<char> tied_to_support<2>(const Bonds&, const State<2>&, const HeldComponents&);
template std::vector<char> tied_to_support<3>(const Bonds&, const State<3>&, const HeldComponents&);

}  // namespace hibi
