#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/field.hpp"
#include "image/view.hpp"
#include "model/model.hpp"
#include "physics/physics.hpp"
#include "results/moment.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// A `where` of the scene: a condition on the reference position, and perhaps one body.
struct Selection {
    std::string text;  ///< as written; empty: everything
    /// Is it met at X, to within a slack (m)? Empty: everything.
    std::function<bool(const Vec3& X, double slack)> condition{};
    int body = -1;  ///< index of a body, or -1 for all

    bool operator()(const Vec3& X, double spacing, int its_body) const {
        return (body < 0 || body == its_body) && (!condition || condition(X, slack_per_spacing * spacing));
    }
};

/// A name of [params]: a quantity or an expression over earlier names. `value` is SI, in `unit`.
struct Parameter {
    std::string name, text;
    double value = 0;
    std::string unit{};  ///< SI symbol; "" for a plain number
};

struct BodySpec {
    std::string name, material;
    Shape<2> shape;
    Field spacing;  ///< constant (m)
    Lattice lattice{};
    std::vector<std::string> bonded_to{};
    std::array<Field, 2> velocity{};  ///< initial (m/s); may vary over x, y
    double spin = 0;                  ///< initial, about the centre of mass (rad/s)
};

struct FixSpec {
    std::string name;
    Selection where;
    std::array<bool, 3> axes{};
};

struct LoadSpec {
    std::string name;
    std::optional<Selection> where{};
    std::optional<std::string> face{};  ///< left, right, bottom, top of `face_body`
    int face_body = 0;
    Load::Kind kind = Load::Kind::force;
    std::array<Field, 3> value{};
    std::array<bool, 3> driven{};
    double ramp = 0;                ///< (s)
    std::optional<Moment> until{};  ///< releases it
    bool primary = false;
    bool no_fail = false;
};

struct DampingSpec {
    Damping damping;
    std::optional<Moment> until{};
};

struct StaticSpec {
    int load_steps = 50;
    bool sequential = true;
};

struct RunSpec {
    std::optional<Moment> until{};  ///< absent: max_time
    double max_time = 0;            ///< (s), required
    std::optional<double> time_step{}, time_step_factor{};
    std::optional<StaticSpec> statics{};  ///< absent: explicit
};

struct SlowSpec {
    Moment around;
    double span = 0;  ///< (s); a fifth of it before the event
    double rate = 1;
};

struct MovieSpec {
    double duration = 12;  ///< of the whole film (s)
    int fps = 25;
    std::vector<SlowSpec> slow{};
    std::optional<double> hold{};  ///< of the last picture, within the duration (s); absent: a twelfth of it
    double flash = 0.6;            ///< of a fresh break (s of playback)
    std::optional<Moment> poster{};           ///< absent: when two thirds of the bonds are broken
    std::vector<std::string> formats{"mp4"};  ///< of film_formats()
    double gif_limit = 10e6;                  ///< (bytes)
    double hold_seconds() const { return hold.value_or(duration / 12); }
    int frames() const { return std::max(1, static_cast<int>(duration * fps + 0.5)); }
};

/// The moments that tell a failure.
inline std::vector<Moment> key_events() {
    return {{EventName::start, 0},
            {EventName::first_break, 0},
            {EventName::peak_load, 0},
            {EventName::separation, 0},
            {EventName::end, 0}};
}

struct StripSpec {
    std::vector<Moment> at = key_events();
};

/// Limits of `hibi test` that a scene sets itself, as Tolerance and RunTolerance have them; what is absent is
/// that of the command.
struct TestLimits {
    std::optional<double> tile{}, pixels{}, mean{}, rmse{}, position{}, load{};
    std::optional<int> break_steps{};

    /// Each limit and the name of its key.
    template <class Self, class Visit>
    static void each(Self& self, Visit&& visit) {
        visit("tile", self.tile);
        visit("pixels", self.pixels);
        visit("mean", self.mean);
        visit("rmse", self.rmse);
        visit("position", self.position);
        visit("break_steps", self.break_steps);
        visit("load", self.load);
    }
};

struct TestSpec {
    int width = 320, height = 180;  ///< (pixels)
    std::vector<Moment> frames = key_events();
    std::vector<std::string> params{};  ///< "name=value" for the test alone
    TestLimits tolerance{};
};

/// A whole experiment, checked; SI. Defaults stand here and in the structs it collects, once.
struct Scene {
    std::filesystem::path file;
    std::string title, about;
    std::vector<Parameter> params;
    int dimension = 2;
    Assumption assumption = Assumption::plane_stress;
    double thickness = 1;    ///< (m)
    double influence = 2.1;  ///< r_e / l0
    Elasticity elasticity = Elasticity::moment_matched;
    std::vector<Material> materials;
    std::vector<BodySpec> bodies;
    std::vector<Notch<2>> notches;
    std::vector<FixSpec> fixes;
    std::vector<LoadSpec> loads;
    std::optional<Gravity> gravity{};
    std::optional<DampingSpec> damping{};
    RunSpec run;
    View view;
    MovieSpec movie;
    StripSpec strip;
    TestSpec test;
};

/// What the solver gets.
template <int Dim>
struct Built {
    Model<Dim> model;
    Physics physics;
    std::vector<std::array<Vec3, 2>> notches;  ///< segments, for drawing
    /// Per body: area of its particles over area of its shape, minus 1.
    std::vector<double> lattice_area_error;
    /// Per body: from the centroid of its shape to the centre of mass of its particles (m).
    std::vector<Vec<Dim>> lattice_centre_error;
};

}  // namespace hibi
