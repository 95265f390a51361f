#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// A support as it is drawn: which particles, and which components are held.
struct Support {
    std::string name;
    std::vector<int> particles;
    std::array<bool, 3> axes{};
};

/// A load as it is drawn. The size over time stands in the history, by name.
struct LoadMark {
    std::string name;
    std::string kind;  ///< "force", "pressure", "displacement", "velocity"
    std::vector<int> particles;
    Vec3 direction =
        Vec3::UnitX();  ///< unit vector along which it is reported; arrows point along load * direction
    bool primary = false;
};

/// The part of a run that never changes: recorded once. Always three components; z = 0 in 2-D.
struct Topology {
    int dimension = 2;
    double thickness = 1;                  ///< of a 2-D body (m)
    std::vector<Vec3> reference_position;  ///< X (m)
    std::vector<double> spacing;           ///< l0 of each particle (m)
    std::vector<int> body;                 ///< index into body_names
    std::vector<std::string> body_names;
    std::vector<int> first, second;   ///< per bond, first < second
    std::vector<double> rest_length;  ///< (m)
    std::vector<Support> supports;
    std::vector<LoadMark> loads;
    std::vector<std::array<Vec3, 2>> notches;  ///< segments (m)
};

/// A copy of what changes, taken between two steps. Arrays are per particle unless they say otherwise.
struct Snapshot {
    double time = 0;  ///< (s)
    std::int64_t step = 0;
    std::vector<Vec3> displacement, velocity;  ///< (m), (m/s)
    std::vector<double> angle;                 ///< thesis variant only, else empty (rad)
    std::vector<int> broken;                   ///< broken bonds, in rising order
    std::vector<double> broken_at;             ///< their times (s), same order

    // Derived, for pictures and for ParaView: single precision.
    std::vector<float> bond_strain;  ///< the intact bond strain of largest magnitude, signed [-]
    std::vector<float> damage;       ///< broken fraction of the particle's bonds, 0..1
    std::vector<float> energy;       ///< elastic energy (J)
    std::vector<std::array<float, 6>>
        stress;  ///< xx, yy, zz, xy, yz, xz (Pa), rotated into the current frame

    int count() const { return static_cast<int>(displacement.size()); }
};

/// Names that scalar_field understands, in the order they are documented.
const std::vector<std::string>& scalar_field_names();

/// One number per particle, to be coloured. Vectors give their magnitude; displacement_x etc. a component.
/// Throws std::out_of_range for a name that is not in scalar_field_names().
std::vector<float> scalar_field(const Topology& topology, const Snapshot& snapshot, const std::string& name);

/// The array of a snapshot that the field is made of, "stress" say.
const std::string& scalar_field_source(const std::string& name);

/// Title and unit of a field for the colour bar, e.g. {"Bond strain", ""} or {"von Mises stress", "Pa"}.
struct FieldLabel {
    std::string title, unit;
    bool is_signed = false;  ///< wants a range symmetric about zero
};
FieldLabel field_label(const std::string& name);

}  // namespace hibi
