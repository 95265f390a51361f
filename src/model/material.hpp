#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace hibi {

/// Random strength: each bond's limit is its material's limit times (-ln U)^(1/shape), U uniform in (0, 1);
/// the material's limit is the scale parameter, reached by 63.2 % of the bonds. Weibull 1951.
struct Weibull {
    double shape = 10;  ///< the larger, the less scatter [-]
    std::uint64_t seed = 1;
};

struct Material {
    std::string name;
    double density = 0;                    ///< (kg/m^3)
    double youngs_modulus = 0;             ///< E (Pa)
    double poissons_ratio = 0;             ///< nu [-]
    std::optional<double> break_strain{};  ///< bond strain at which a bond fails [-]
    std::optional<double>
        fracture_energy{};      ///< Gc (J/m^2); gives the limit strain where break_strain is absent
    bool tension_only = false;  ///< a shortened bond never fails
    std::optional<Weibull> weibull{};

    bool can_break() const { return break_strain || fracture_energy; }
};

enum class Assumption { plane_stress, plane_strain };

/// mu = E / (2 (1 + nu)) (Pa)
double shear_modulus(const Material& m);
/// lambda = E nu / (1 - nu^2) in plane stress, E nu / ((1 + nu)(1 - 2 nu)) in plane strain and in 3-D (Pa)
double lame_lambda(const Material& m, Assumption assumption);

}  // namespace hibi
