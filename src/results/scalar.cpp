#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "results/snapshot.hpp"

namespace hibi {

namespace {

using Stress = std::array<float, 6>;  // xx, yy, zz, xy, yz, xz (Pa)

/// Largest principal stress (Pa): of the plane in two dimensions, where the stress across it has its own
/// meaning (none in plane stress, a reaction in plane strain), of space in three.
double largest_principal(const Stress& s, int dimension) {
    const double xx = s[0], yy = s[1], xy = s[3];
    if (dimension == 2) return (xx + yy) / 2 + std::sqrt((xx - yy) * (xx - yy) / 4 + xy * xy);
    Mat<3> tensor;
    tensor << s[0], s[3], s[5],  //
        s[3], s[1], s[4],        //
        s[5], s[4], s[2];
    return Eigen::SelfAdjointEigenSolver<Mat<3>>(tensor, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// sqrt(3/2 s:s) with s the deviator of the stress (Pa); equals the stress in a bar under plain tension.
double von_mises(const Stress& s) {
    const double xx = s[0], yy = s[1], zz = s[2], xy = s[3], yz = s[4], xz = s[5];
    const double normal = (xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx);
    return std::sqrt(normal / 2 + 3 * (xy * xy + yz * yz + xz * xz));
}

using Values = std::function<std::vector<float>(const Topology&, const Snapshot&)>;

struct Entry {
    std::string name;
    FieldLabel label;
    std::string source;  ///< the array of a snapshot it is made of
    Values values;
};

/// The values of a whole field from those of one particle: called once per field, not once per particle.
template <class Value>
Values of_each(Value value) {
    return [value](const Topology& t, const Snapshot& s) {
        std::vector<float> values(s.count());
        for (int i = 0; i < s.count(); ++i) values[i] = static_cast<float>(value(t, s, i));
        return values;
    };
}

Values stress_component(int component) {
    return of_each([component](const Topology&, const Snapshot& s, int i) { return s.stress[i][component]; });
}

/// The one list of fields that can be coloured: a new one is one entry.
const std::vector<Entry>& entries() {
    using T = const Topology&;
    using S = const Snapshot&;
    static const std::vector<Entry> list = {
        {"displacement", {"Displacement", "m"}, "displacement", of_each([](T, S s, int i) {
             return s.displacement[i].norm();
         })},
        {"displacement_x", {"Displacement x", "m", true}, "displacement", of_each([](T, S s, int i) {
             return s.displacement[i].x();
         })},
        {"displacement_y", {"Displacement y", "m", true}, "displacement", of_each([](T, S s, int i) {
             return s.displacement[i].y();
         })},
        {"velocity", {"Velocity", "m/s"}, "velocity", of_each([](T, S s, int i) {
             return s.velocity[i].norm();
         })},
        {"bond_strain", {"Bond strain", "", true}, "bond_strain", of_each([](T, S s, int i) {
             return s.bond_strain[i];
         })},
        {"stress_xx", {"Stress xx", "Pa", true}, "stress", stress_component(0)},
        {"stress_yy", {"Stress yy", "Pa", true}, "stress", stress_component(1)},
        {"stress_xy", {"Stress xy", "Pa", true}, "stress", stress_component(3)},
        {"principal_stress", {"Largest principal stress", "Pa", true}, "stress", of_each([](T t, S s, int i) {
             return largest_principal(s.stress[i], t.dimension);
         })},
        {"von_mises", {"von Mises stress", "Pa"}, "stress", of_each([](T, S s, int i) {
             return von_mises(s.stress[i]);
         })},
        {"pressure", {"Pressure", "Pa", true}, "stress", of_each([](T, S s, int i) {
             return -(double(s.stress[i][0]) + s.stress[i][1] + s.stress[i][2]) / 3;
         })},
        {"damage", {"Damage", ""}, "damage", of_each([](T, S s, int i) { return s.damage[i]; })},
        {"energy", {"Elastic energy", "J"}, "energy", of_each([](T, S s, int i) { return s.energy[i]; })},
    };
    return list;
}

const Entry& entry(const std::string& name) {
    const auto found = std::ranges::find(entries(), name, &Entry::name);
    if (found == entries().end()) throw std::out_of_range("no field \"" + name + "\"");
    return *found;
}

}  // namespace

const std::vector<std::string>& scalar_field_names() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Entry& e : entries()) list.push_back(e.name);
        return list;
    }();
    return names;
}

std::vector<float> scalar_field(const Topology& topology, const Snapshot& snapshot, const std::string& name) {
    return entry(name).values(topology, snapshot);
}

const std::string& scalar_field_source(const std::string& name) { return entry(name).source; }

FieldLabel field_label(const std::string& name) { return entry(name).label; }

}  // namespace hibi
