#pragma once
#include <vector>

#include "model/model.hpp"

namespace hibi {

/// A bond along which the shear modulus changes: a chain of springs in series, one for each material that it
/// passes through.
struct MixedBond {
    int bond = 0;
    double modulus = 0;            ///< mu of the chain (Pa): 1 / (mean of 1 / mu along the bond)
    double first_length = 0.5;     ///< part of its length that counts as the first end's, 0 to 1; the rest is
                                   ///< the second end's
    std::vector<int> materials{};  ///< that it passes through, rising
};

/// All bonds that are mixed, in rising order; none where all materials have one shear modulus. A point of a
/// bond has the material of the particle that is nearest to it, among both ends and their neighbours. So a
/// bond between two particles of one material is mixed as well where a thin layer of another lies between.
template <int Dim>
std::vector<MixedBond> mixed_bonds(const Model<Dim>& model);

}  // namespace hibi
