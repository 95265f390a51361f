#include <cmath>
#include <nlohmann/json.hpp>

#include "picture_tests/diff.hpp"
#include "picture_tests/findings.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;

Json pixels_json(const PixelDifference& d) {
    return {{"tile", d.tile}, {"tile_at", d.tile_at}, {"pixels", d.pixels},   {"far_pixels", d.far_pixels},
            {"mean", d.mean}, {"rmse", d.rmse},       {"largest", d.largest}, {"ssim", d.ssim}};
}

Json limits_json(const Tolerance& t) {
    return {{"tile", t.tile}, {"pixels", t.pixels}, {"mean", t.mean}, {"rmse", t.rmse}};
}

Json place_json(const std::optional<PositionsDifference::Place>& place) {
    if (!place) return nullptr;
    const Vec3& X = place->reference_position;
    return {{"distance", place->distance},
            {"spacings", place->spacings},
            {"time", place->time},
            {"particle", place->particle},
            {"position", {X.x(), X.y(), X.z()}}};
}

/// JSON has no infinity: null where it did not break.
Json time_json(double time) { return std::isfinite(time) ? Json(time) : Json(nullptr); }

Json states_json(const RunDifference& d) {
    if (!d.other_body.empty()) return {{"other_body", d.other_body}};
    Json first = nullptr;
    if (const auto& bond = d.bonds.first)
        first = {{"bond", bond->bond},
                 {"particles", {bond->first, bond->second}},
                 {"expected_time", time_json(bond->expected)},
                 {"actual_time", time_json(bond->actual)},
                 {"steps", bond->steps}};
    return {{"other_body", nullptr},
            {"moments", d.positions.compared},
            {"interpolated", d.positions.interpolated},
            {"largest", place_json(d.positions.largest)},
            {"first_beyond", place_json(d.positions.first_beyond)},
            {"broken", {{"expected", d.bonds.expected_broken}, {"actual", d.bonds.actual_broken}}},
            {"changed_bonds", d.bonds.changed},
            {"first_bond", first}};
}

Json pair_json(const CurveDifference::Pair& pair) {
    const auto value = [](const std::optional<double>& v) { return v ? Json(*v) : Json(nullptr); };
    return {{"expected", value(pair.expected)}, {"actual", value(pair.actual)}};
}

Json curve_json(const RunDifference& d) {
    if (!d.curve) return nullptr;
    return {{"peak_load", pair_json(d.curve->peak)},
            {"first_break_load", pair_json(d.curve->first_break)},
            {"largest", d.curve->largest},
            {"largest_time", d.curve->largest_time},
            {"first_beyond", d.curve->first_beyond ? Json(*d.curve->first_beyond) : Json(nullptr)}};
}

}  // namespace

std::string findings_json(const Findings& f, const DiffOptions& options) {
    Json pixels = nullptr;
    if (!f.other_frames.empty())
        pixels = {{"sameness", f.pixels == Sameness::different ? Json(to_string(f.pixels)) : Json(nullptr)},
                  {"obstacle", f.other_frames}};
    if (f.worst) {
        Json frames = Json::array();
        for (const FrameDifference& frame : f.frames) {
            Json row{{"name", frame.name}, {"sameness", to_string(frame.sameness)}};
            row.update(pixels_json(frame.pixels));
            frames.push_back(row);
        }
        pixels = {{"sameness", to_string(f.pixels)},
                  {"limits", limits_json(options.pixels)},
                  {"worst", f.worst->name},
                  {"frames", frames}};
    }
    const Json json{{"verdict", f.verdict},
                    {"detail", f.detail},
                    {"sameness", to_string(f.all())},
                    {"pixels", pixels},
                    {"not_compared", f.not_compared},
                    {"states", f.run ? states_json(*f.run) : Json(nullptr)},
                    {"curve", f.run ? curve_json(*f.run) : Json(nullptr)}};
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace hibi
