#include "model/material.hpp"

namespace hibi {

double shear_modulus(const Material& m) { return m.youngs_modulus / (2 * (1 + m.poissons_ratio)); }

double lame_lambda(const Material& m, Assumption assumption) {
    const double E = m.youngs_modulus, nu = m.poissons_ratio;
    return assumption == Assumption::plane_stress ? E * nu / (1 - nu * nu)
                                                  : E * nu / ((1 + nu) * (1 - 2 * nu));
}

}  // namespace hibi
