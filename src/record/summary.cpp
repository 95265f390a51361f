#include "record/summary.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "record/files.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;  // keeps the order in which a reader looks for things

template <class T>
Json or_null(const std::optional<T>& value) {
    return value ? Json(*value) : Json(nullptr);
}

Json position_json(const Vec3& position, int dimension) {
    return std::vector<double>(position.data(), position.data() + dimension);
}

Vec3 position_from_json(const Json& json) {
    Vec3 position = Vec3::Zero();
    const auto values = json.get<std::vector<double>>();
    for (std::size_t a = 0; a < std::min<std::size_t>(3, values.size()); ++a)
        position[static_cast<int>(a)] = values[a];
    return position;
}

Json event_json(const std::optional<Event>& event, int dimension) {
    if (!event) return nullptr;
    return {{"time", event->time},
            {"load", event->load},
            {"displacement", event->displacement},
            {"position", position_json(event->position, dimension)}};
}

/// The peak of a load has a time, but no place.
Json without_place(Json event) {
    if (!event.is_null()) event["position"] = nullptr;
    return event;
}

/// JSON has no word for a number that is not finite; it is written as null.
double number(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

std::optional<Event> event_from_json(const Json& json) {
    if (json.is_null()) return std::nullopt;
    Event event{number(json.at("time")), number(json.at("load")), number(json.at("displacement"))};
    if (json.at("position").is_null()) return event;
    event.position = position_from_json(json.at("position"));
    return event;
}

Json seconds_json(const std::map<std::string, double>& seconds) {
    Json json;
    for (const char* part : {"setup", "solve", "draw", "encode", "total"}) json[part] = 0.0;  // always there
    for (const auto& [part, value] : seconds) json[part] = value;
    return json;
}

Json profile_json(const RunSummary& s) {
    Json json = Json::object();
    for (const auto& [phase, stages] : s.profile) {
        Json list = Json::array();
        for (const StageTime& stage : stages)
            list.push_back({{"stage", stage.name}, {"seconds", stage.seconds}, {"calls", stage.calls}});
        json[phase] = list;
    }
    return json;
}

void profile_from_json(const Json& json, RunSummary& s) {
    for (const auto& [phase, stages] : json.items())
        for (const Json& stage : stages)
            s.profile[phase].push_back({stage.at("stage"), stage.at("seconds"), stage.at("calls")});
}

Json to_json(const RunSummary& s) {
    Json json = {
        {"scene",
         {{"title", s.title}, {"hash", s.scene_hash}, {"file", s.scene_file}, {"parameters", s.parameters}}},
        {"version", s.version},
        {"command", s.command},
        {"counts",
         {{"particles", s.particles},
          {"bonds", s.bonds},
          {"broken", s.broken},
          {"steps", s.steps},
          {"frames", s.frames}}},
        {"fps", s.fps},
        {"dimension", s.dimension},
        {"time_step", s.time_step},
        {"end_time", s.end_time},
        {"events",
         {{"first_break", event_json(s.events.first_break, s.dimension)},
          {"peak_load", without_place(event_json(s.events.peak_load, s.dimension))},
          {"separation", event_json(s.events.separation, s.dimension)},
          {"end", s.events.end}}},
        {"cracks",
         {{"length", s.crack.length},
          {"tip", s.crack.tip ? position_json(*s.crack.tip, s.dimension) : Json(nullptr)},
          {"speed", s.crack.speed},
          {"top_speed", s.top_crack_speed}}},
        {"fragments",
         {{"count", s.fragments.count},
          {"largest_mass", s.fragments.largest},
          {"debris_mass", s.fragments.debris}}},
        {"energy",
         {{"worst_imbalance", s.worst_imbalance},
          {"imbalance_at_first_break", s.imbalance_at_first_break},
          {"trusted", s.trusted}}},
        {"seconds", seconds_json(s.seconds)},
        {"threads", s.threads},
        {"stopped", or_null(s.stopped)},
        {"warnings", s.warnings}};
    if (!s.profile.empty()) json["profile"] = profile_json(s);
    return json;
}

RunSummary from_json(const Json& json) {
    RunSummary s;
    json.at("scene").at("title").get_to(s.title);
    json.at("scene").at("hash").get_to(s.scene_hash);
    json.at("scene").at("file").get_to(s.scene_file);
    // Runs of earlier versions lack them.
    s.parameters = json.at("scene").value("parameters", s.parameters);
    s.command = json.value("command", "");
    json.at("version").get_to(s.version);
    const Json& counts = json.at("counts");
    counts.at("particles").get_to(s.particles);
    counts.at("bonds").get_to(s.bonds);
    counts.at("broken").get_to(s.broken);
    counts.at("steps").get_to(s.steps);
    counts.at("frames").get_to(s.frames);
    s.fps = json.value("fps", 0);
    json.at("dimension").get_to(s.dimension);
    json.at("time_step").get_to(s.time_step);
    json.at("end_time").get_to(s.end_time);
    const Json& events = json.at("events");
    s.events.first_break = event_from_json(events.at("first_break"));
    s.events.peak_load = event_from_json(events.at("peak_load"));
    s.events.separation = event_from_json(events.at("separation"));
    events.at("end").get_to(s.events.end);
    if (const auto cracks = json.find("cracks");
        cracks != json.end()) {  // runs of earlier versions lack them
        s.crack.length = number(cracks->at("length"));
        if (!cracks->at("tip").is_null()) s.crack.tip = position_from_json(cracks->at("tip"));
        s.crack.speed = number(cracks->at("speed"));
        s.top_crack_speed = number(cracks->at("top_speed"));
        const Json& fragments = json.at("fragments");
        fragments.at("count").get_to(s.fragments.count);
        s.fragments.largest = number(fragments.at("largest_mass"));
        s.fragments.debris = number(fragments.at("debris_mass"));
    }
    const Json& energy = json.at("energy");
    s.worst_imbalance = number(energy.at("worst_imbalance"));
    s.imbalance_at_first_break = number(energy.at("imbalance_at_first_break"));
    energy.at("trusted").get_to(s.trusted);
    json.at("seconds").get_to(s.seconds);
    json.at("threads").get_to(s.threads);
    if (const Json& stopped = json.at("stopped"); !stopped.is_null()) s.stopped = stopped.get<std::string>();
    json.at("warnings").get_to(s.warnings);
    if (const auto profile = json.find("profile"); profile != json.end()) profile_from_json(*profile, s);
    return s;
}

}  // namespace

void write_summary(const std::filesystem::path& folder, const RunSummary& summary) {
    write_file(folder / "run.json",
               to_json(summary).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

RunSummary read_summary(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "run.json";
    const std::string text = read_file(file);
    try {
        return from_json(Json::parse(text));
    } catch (const Json::exception& error) {
        throw std::runtime_error(
            fmt::format("{}: not the summary of a run: {}", file.string(), error.what()));
    }
}

void write_frames(const std::filesystem::path& folder, const std::vector<FrameInfo>& frames) {
    Json list = Json::array();
    for (const FrameInfo& frame : frames)
        list.push_back({{"file", frame.file},
                        {"time", frame.time},
                        {"event", or_null(frame.event)},
                        {"events", frame.events},
                        {"broken", frame.broken},
                        {"sha256", frame.sha256}});
    write_file(folder / "frames.json", list.dump(1) + "\n");
}

std::vector<FrameInfo> read_frames(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "frames.json";
    std::vector<FrameInfo> frames;
    if (!std::filesystem::exists(file)) return frames;
    const std::string text = read_file(file);
    try {
        for (const Json& row : Json::parse(text)) {
            FrameInfo frame{.file = row.at("file"), .time = row.at("time"), .sha256 = row.at("sha256")};
            if (!row.at("event").is_null()) frame.event = row.at("event").get<std::string>();
            row.at("events").get_to(frame.events);
            row.at("broken").get_to(frame.broken);
            frames.push_back(frame);
        }
    } catch (const Json::exception& error) {
        throw std::runtime_error(fmt::format("{}: not a list of frames: {}", file.string(), error.what()));
    }
    return frames;
}

}  // namespace hibi
