#include "app/doctor.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/parallel.hpp"
#include "base/units.hpp"
#include "film/encoder.hpp"
#include "image/font_data.hpp"
#include "image/text.hpp"
#include "elasticity/bond_kernel.hpp"
#include "render/renderer.hpp"

namespace hibi {

namespace {

struct Finding {
    std::string name;
    bool works = false;
    bool needed = true;     ///< without it there is no film
    std::string found;      ///< what is there, or why it does not work
    std::string way_out{};  ///< what helps where it does not work, unless `found` says so
};

/// Looks with `look`, which says what it found, or throws why it does not work.
Finding examine(const std::string& name, bool needed, const std::string& way_out,
                const std::function<std::string()>& look) {
    try {
        return {name, true, needed, look()};
    } catch (const std::exception& error) {
        return {name, false, needed, error.what(), way_out};
    }
}

std::string look_at_renderer(GlBackend backend) {
    View view;
    view.width = view.height = 16;
    const Topology nothing;
    return Renderer(view, nothing, {.backend = backend}).description();
}

std::string look_at_encoder() {
    std::string name = encoder_name();
    if (name.empty()) throw std::runtime_error("these FFmpeg libraries cannot encode H.264");
    return name;
}

std::string look_at_units() {
    if (!unit_atom("MPa")) throw std::runtime_error("the table of units does not know MPa");
    return "UDUNITS-2";
}

std::string look_at_fonts() {
    require_glyphs("Crack ひび 裂缝 균열 трещина ρωγμή شرخ סדק दरार รอยแตก ↔");
    return fmt::format("{}, built in: Inter, IPAex Gothic and others", built_in_fonts().size());
}

std::string look_at_output() {
    const std::filesystem::path here = std::filesystem::current_path();
    const std::filesystem::path out = std::filesystem::exists(here / "out") ? here / "out" : here;
    if (access(out.c_str(), W_OK | X_OK) != 0) throw std::runtime_error(out.string() + " cannot be written");
    return (here / "out").string();
}

std::vector<Finding> examine_all() {
    std::vector<Finding> findings;
    findings.push_back(
        {"version", true, true, fmt::format("hibi {}, compiler {}", HIBI_VERSION, __VERSION__)});
    findings.push_back({"threads", true, true, std::to_string(threads())});
    findings.push_back({"processor", true, true, fmt::format("loops for level {}", kernel::loops().level)});
    findings.push_back(examine("renderer osmesa", true, "install libosmesa6",
                               [] { return look_at_renderer(GlBackend::osmesa); }));
    findings.push_back(examine("renderer egl", false, "install libegl1 and libgl1-mesa-dri",
                               [] { return look_at_renderer(GlBackend::egl); }));
    findings.push_back(examine("video encoder", true, "install libavcodec59", look_at_encoder));
    findings.push_back(examine("fonts", true,
                               "install the packages fonts-... of dependencies.txt, then build again",
                               look_at_fonts));
    findings.push_back(examine("units", true, "", look_at_units));
    findings.push_back(
        examine("output folder", true, "change to a folder of your own, or give -o DIR", look_at_output));
    return findings;
}

void print_text(const std::vector<Finding>& findings) {
    for (const Finding& f : findings) {
        const char* state = f.works ? "ok" : f.needed ? "MISSING" : "missing";
        fmt::print("{:<8} {:<16} {}\n", state, f.name, f.found);
        if (!f.works)
            fmt::print("{:<8} {:<16} {}{}\n", "", "", f.way_out,
                       f.needed ? "" : " (films can be made without)");
    }
}

void print_json(const std::vector<Finding>& findings) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Finding& f : findings)
        list.push_back({{"name", f.name},
                        {"works", f.works},
                        {"needed", f.needed},
                        {"found", f.found},
                        {"way_out", f.way_out}});
    fmt::print("{}\n", list.dump(2));
}

}  // namespace

int doctor_command(bool json) {
    const std::vector<Finding> findings = examine_all();
    if (json)
        print_json(findings);
    else
        print_text(findings);
    for (const Finding& f : findings)
        if (f.needed && !f.works) return 1;
    return 0;
}

}  // namespace hibi
