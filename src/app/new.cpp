#include "app/new.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "app/schema_line.hpp"
#include "base/process.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/suggest.hpp"

namespace hibi {

namespace {

constexpr const char* starter =
    R"(# A scene: one experiment. `hibi run` makes a film of it, `hibi check` says what would be modelled.
# Every block and key is explained in scenes/REFERENCE.md. Quantities carry their unit, and may be computed
# from the names in [params]; override those with -p, for example -p spacing=0.25m
version = 1
title   = "A notched beam, bent until it breaks"
about   = "8 m x 2 m, held on the left, cut from above beside the clamp, pushed down at the right end."

[params]
spacing = "0.2 m"                  # smaller: more particles, a finer crack, a longer run

[material.concrete]
density        = "2300 kg/m^3"
youngs_modulus = "30 GPa"
poissons_ratio = 0.2
break_strain   = 0.0005            # a bond breaks when it is stretched or shortened by more: strength / E
# tension_only = true              # shortened bonds never break: for what is far stronger in compression

[[body]]
name     = "beam"
material = "concrete"
box      = [["0 m", "0 m"], ["8 m", "2 m"]]    # also disc, ring, polygon, difference
spacing  = "spacing"

[[notch]]                          # bonds that cross this line, between two columns, are cut before the run
line = [["2 m", "2 m"], ["2 m", "1.5 m"]]

[[fix]]
name  = "clamp"
where = "x < spacing"              # particle centres; here the first column
hold  = ["x", "y"]

[[load]]
name  = "tip"
where = "x > 8 m - spacing"
force = ["0 N", "-4 MN"]           # total, in equal shares
ramp  = "2 s"                      # grows evenly from nothing
until = "separation"               # then what is torn off flies freely

[damping]
ratio = 0.3                        # of the first vibration
until = "separation"               # fragments fly undamped

[run]
until    = "separation + 0.02 s"   # or a time, first_break, peak_load
max_time = "2 s"                   # at the latest
)";

int refuse(const std::string& message) {
    fmt::print(stderr, "hibi new: error: {}\n", message);
    return 2;
}

/// The title of a scene: what stands in quotes behind `title =`.
std::string title_of(const std::string& text) {
    const std::size_t key = text.find("\ntitle");
    const std::size_t open = key == std::string::npos ? key : text.find('"', key);
    const std::size_t close = open == std::string::npos ? open : text.find('"', open + 1);
    return close == std::string::npos ? "" : text.substr(open + 1, close - open - 1);
}

}  // namespace

int new_command(const NewOptions& options) {
    const auto& [name, from, list] = options;
    if (list) {
        bool verification = false;
        for (const auto& [scene, text] : built_in_scenes()) {
            if (!verification && scene.starts_with("verify/")) {
                verification = true;
                fmt::print("\nThose of hibi verify, whose answers are known:\n");
            }
            fmt::print("{:<{}} {}\n", scene, verification ? 32 : 24, title_of(text));
        }
        return 0;
    }
    std::string text = starter;
    if (!from.empty()) {
        std::optional<std::string> found;
        std::vector<std::string> known;
        for (const auto& [scene, its_text] : built_in_scenes()) {
            known.push_back(scene);
            if (scene == from || scene + ".toml" == from) found = its_text;
        }
        if (!found) {
            const auto near = nearest(from, known);
            return refuse(
                fmt::format("no built-in scene \"{}\"; {}", from,
                            near ? fmt::format("did you mean \"{}\"?", *near) : "known: " + list_of(known)));
        }
        text = *found;
    }
    std::filesystem::path file = name.empty() ? "my_scene.toml" : name;
    if (file.extension() != ".toml") file += ".toml";
    if (std::filesystem::exists(file))
        return refuse(fmt::format("{} exists already; give another name", file.string()));
    std::ofstream out(file, std::ios::binary);
    out << with_schema_line(text, schema_file(this_program()));
    out.close();
    if (!out) throw std::runtime_error(fmt::format("cannot write {}", file.string()));
    fmt::print("{}\n", file.string());
    return 0;
}

}  // namespace hibi
