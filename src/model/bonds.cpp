#include "model/bonds.hpp"

namespace hibi {

void index_bonds(Bonds& bonds, int particles) {
    bonds.start.assign(particles + 1, 0);
    for (int b = 0; b < bonds.count(); ++b) {
        ++bonds.start[bonds.first[b] + 1];
        ++bonds.start[bonds.second[b] + 1];
    }
    for (int i = 0; i < particles; ++i) bonds.start[i + 1] += bonds.start[i];
    bonds.bonds_of.resize(2 * bonds.first.size());
    std::vector<int> next(bonds.start.begin(), bonds.start.end() - 1);
    for (int b = 0; b < bonds.count(); ++b) {
        bonds.bonds_of[next[bonds.first[b]]++] = b;
        bonds.bonds_of[next[bonds.second[b]]++] = b;
    }
}

}  // namespace hibi
