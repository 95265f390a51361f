#include "scene/keys.hpp"

#include <stdexcept>

#include "film/encoder.hpp"
#include "image/theme.hpp"
#include "image/view.hpp"
#include "results/snapshot.hpp"

namespace hibi {

namespace {

std::vector<std::string> map_choices() {
    std::vector<std::string> names = colour_map_names();
    names.insert(names.begin(), "auto");
    return names;
}

}  // namespace

const Key* KeyBlock::find(const std::string& key) const {
    for (const Key& k : keys)
        if (k.name == key) return &k;
    return nullptr;
}

std::vector<std::string> KeyBlock::key_names() const {
    std::vector<std::string> names;
    for (const Key& key : keys) names.push_back(key.name);
    return names;
}

const KeyBlock& scene_block(const std::string& name) {
    for (const KeyBlock& block : scene_blocks())
        if (block.name == name) return block;
    throw std::out_of_range("no block " + name);
}

// One key per line as far as it goes: this is read as a table.
// clang-format off
const std::vector<KeyBlock>& scene_blocks() {
    using enum KeyKind;
    using Form = KeyBlock::Form;
    static const std::vector<KeyBlock> blocks{
        {"", "the top of the file", Form::single, "What the experiment is.", {
            {"version", integer, "", "1", "version of the scene format", "1"},
            {"title", text, "", "the file's name", "shown on every frame; one line, in any script; there are no emoji", R"("Bending failure")"},
            {"about", text, "", "empty", "what it shows, and where it is from", R"("Figure 7 of ...")"},
        }},
        {"model", "[model]", Form::single, "The kind of model.", {
            {"dimension", integer, "", "2", "2; three dimensions are not available yet", "2"},
            {"assumption", choice, "", "plane stress", "what happens across the plane", R"("plane strain")",
             {"plane stress", "plane strain"}},
            {"thickness", quantity, "m", "1 m",
             "of the body, across the plane; forces are those of a body this thick",
             R"("0.2 m")"},
            {"influence", quantity, "", "2.1",
             "radius within which particles are bonded, in spacings; above sqrt 2",
             "2.1"},
            {"elasticity", choice, "", "moment-matched",
             "moment-matched: weights corrected at surfaces, rotation from the deformation; thesis: plain "
             "weights and an independent angle per particle, as in the first MPS papers",
             R"("thesis")", {"moment-matched", "thesis"}},
        }},
        {"material", "[material.NAME]", Form::named, "A material, by name.", {
            {"density", quantity, "kg/m^3", "required", "mass per volume", R"("2300 kg/m^3")"},
            {"youngs_modulus", quantity, "Pa", "required", "E", R"("210 MPa")"},
            {"poissons_ratio", quantity, "", "required", "nu, above -1 and below 0.5", "0.3"},
            {"break_strain", quantity, "", "",
             "a bond breaks when its strain exceeds this; absent: it never breaks",
             "0.1"},
            {"fracture_energy", quantity, "J/m^2", "",
             "energy that a unit of crack area costs, in place of break_strain: for bodies with notches",
             R"("100 J/m^2")"},
            {"tension_only", flag, "", "false", "shortened bonds never break", "true"},
            {"weibull", table, "weibull", "", "random strength: each bond has a limit of its own",
             "{ shape = 12, seed = 7 }"},
        }, true, true},
        {"weibull", "weibull", Form::inner, "Weibull distribution of the bonds' limits.", {
            {"shape", quantity, "", "required", "the larger, the less scatter", "12"},
            {"seed", integer, "", "1", "another number, another sample", "7"},
        }},
        {"body", "[[body]]", Form::list, "A body, of exactly one shape.", {
            {"name", text, "", "body1, body2, ...", "for messages and for `body = ` elsewhere", R"("plate")"},
            {"material", text, "", "required", "a name of [material]", R"("concrete")"},
            {"box", points, "m", "", "two corners; each side holds a whole number of spacings, unless the lattice is turned",
             R"([["0 m", "0 m"], ["40 m", "20 m"]])"},
            {"disc", table, "disc", "", "a full circle", R"({ centre = ["0 m", "0 m"], radius = "1 m" })"},
            {"ring", table, "ring", "", "a circle with a hole",
             R"({ centre = ["0 m", "0 m"], inner = "0.8 m", outer = "1 m" })"},
            {"polygon", points, "m", "", "corners, one after the other; no side crosses another",
             R"([["0 m", "0 m"], ["4 m", "0 m"], ["0 m", "3 m"]])"},
            {"difference", tables, "shape", "", "the first shape less all the others",
             R"([{ box = [[0, 0], [4, 4]] }, { disc = { centre = [2, 2], radius = "1 m" } }])"},
            {"spacing", quantity, "m", "required", "distance of neighbouring particles", R"("1 m")"},
            {"lattice", table, "lattice", "", "how the particles are arranged; absent: in rows along x",
             R"({ angle = "30 deg", jitter = 0.1 })"},
            {"bonded_to", names, "", "[]", "bodies above this one, of the same spacing, that it is glued to",
             R"(["plate"])"},
            {"velocity", vector, "m/s", "[0, 0]", "at the start", R"(["3 m/s", "0 m/s"])", {}, true},
            {"spin", quantity, "1/s", "0", "at the start, about its centre of mass, counter-clockwise",
             R"("2 rad/s")"},
        }, true, true},
        {"lattice", "lattice", Form::inner, "Arrangement of the particles of a body.", {
            {"angle", quantity, "", "0", "of the rows to the x axis, counter-clockwise", R"("30 deg")"},
            {"jitter", quantity, "", "0",
             "each particle is moved by up to this many spacings in x and in y, at random; 0.4 at most", "0.1"},
            {"seed", integer, "", "1", "another number, another jitter", "7"},
        }},
        {"disc", "disc", Form::inner, "A full circle.", {
            {"centre", point, "m", "required", "", R"(["0 m", "0 m"])"},
            {"radius", quantity, "m", "required", "", R"("1 m")"},
        }},
        {"ring", "ring", Form::inner, "A circle with a hole.", {
            {"centre", point, "m", "required", "", R"(["0 m", "0 m"])"},
            {"inner", quantity, "m", "required", "radius of the hole", R"("0.8 m")"},
            {"outer", quantity, "m", "required", "radius", R"("1 m")"},
        }},
        {"shape", "difference", Form::inner, "One shape of a difference.", {
            {"box", points, "m", "", "as in [[body]]", R"([["0 m", "0 m"], ["40 m", "20 m"]])"},
            {"disc", table, "disc", "", "as in [[body]]", R"({ centre = ["0 m", "0 m"], radius = "1 m" })"},
            {"ring", table, "ring", "", "as in [[body]]",
             R"({ centre = ["0 m", "0 m"], inner = "0.8 m", outer = "1 m" })"},
            {"polygon", points, "m", "", "as in [[body]]",
             R"([["0 m", "0 m"], ["4 m", "0 m"], ["0 m", "3 m"]])"},
        }},
        {"notch", "[[notch]]", Form::list, "A cut made before the run; exactly one of line and polyline.", {
            {"name", text, "", "notch1, notch2, ...", "for messages", R"("slit")"},
            {"line", points, "m", "", "two points; bonds that cross or touch the cut are gone",
             R"([["0 m", "10 m"], ["5 m", "10 m"]])"},
            {"polyline", points, "m", "", "two points or more",
             R"([["0 m", "10 m"], ["5 m", "10 m"], ["6 m", "12 m"]])"},
            {"body", text, "", "all bodies", "the only body it cuts", R"("plate")"},
        }},
        {"fix", "[[fix]]", Form::list, "A support: particles held in place.", {
            {"name", text, "", "fix1, fix2, ...", "for messages", R"("clamp")"},
            {"where", condition, "", "required, unless body is given", "which particles", R"("x < spacing")"},
            {"body", text, "", "all bodies", "only particles of this body", R"("plate")"},
            {"hold", choices, "", "required", "directions in which they cannot move; one alone is a roller",
             R"(["x", "y"])", {"x", "y", "z"}},
        }},
        {"load", "[[load]]", Form::list,
         "A load: exactly one of force, pressure, displacement, velocity, on a selection or on a face.", {
            {"name", text, "", "load1, load2, ...", "column load.NAME of history.csv", R"("tip")"},
            {"where", condition, "", "required, unless face or body is given", "which particles",
             R"("x > 39 m")"},
            {"body", text, "", "all bodies", "only particles of this body; with face: the body it belongs to",
             R"("plate")"},
            {"face", choice, "", "", "a side of a box, for force or pressure", R"("right")",
             {"left", "right", "bottom", "top"}},
            {"force", vector, "N", "",
             "total force; with where in equal shares, with face by the face's areas",
             R"(["0 N", "-80 MN"])", {}, true},
            {"pressure", quantity, "Pa", "", "pushes into the body; negative pulls", R"("2 MPa")", {}, true},
            {"displacement", vector, "m", "", R"(prescribed; "free" leaves a direction alone)",
             R"(["1 mm", "free"])", {},
             true},
            {"velocity", vector, "m/s", "", R"(prescribed; "free" leaves a direction alone)",
             R"(["free", "-3 m/s"])", {},
             true},
            {"pulse", table, "", "", "a pressure pulse", "{ }", {}, false, false},
            {"ramp", quantity, "s", "0 s",
             "grows evenly from nothing to the full value in this time, then stays",
             R"("40 s")"},
            {"until", moment, "", "never", "when it is taken away", R"("separation")"},
            {"primary", flag, "", "true for the first load if none says so",
             "drives the curve and the events; one load at most", "true"},
            {"no_fail", flag, "", "false", "bonds between two of its particles never break", "true"},
        }},
        {"gravity", "[gravity]", Form::single, "Weight; absent: none.", {
            {"acceleration", vector, "m/s^2", "[0, -9.80665]", "of every particle",
             R"(["0 m/s^2", "-9.81 m/s^2"])"},
        }},
        {"damping", "[damping]", Form::single,
         "Drag on every particle, in proportion to its mass; absent: none. In place of the block, above the first one: "
         "damping = \"quasi-static\", a ratio of 0.3 until separation.", {
            {"ratio", quantity, "", "",
             "of the first mode of vibration; 1 just suppresses it. For bodies that are held",
             "0.3"},
            {"rate", quantity, "1/s", "", "c in a = -c v, in place of ratio", R"("0.5 s^-1")"},
            {"until", moment, "", "never", "when it ends", R"("separation")"},
        }, true, false, {"quasi-static"}},
        {"run", "[run]", Form::single, "How long, and in which steps.", {
            {"until", moment, "", "max_time", "when the run ends", R"("separation + 0.5 s")"},
            {"max_time", quantity, "s", "required, unless until is a time", "when it ends at the latest",
             R"("60 s")"},
            {"method", choice, "", "explicit",
             "explicit: motion in time; static: from equilibrium to equilibrium, while the loads rise with "
             "the time",
             R"("static")", {"explicit", "static"}},
            {"load_steps", integer, "", "50", "with method static: in how many even steps max_time is reached",
             "100"},
            {"breaking", choice, "", "sequential",
             "with method static: sequential breaks one bond at a time, the others moving towards equilibrium "
             "until the next is at its limit; together breaks all that are beyond theirs in equilibrium",
             R"("together")", {"sequential", "together"}},
            {"time_step", quantity, "s", "chosen", "must be below the stable limit", R"("1 ms")"},
            {"time_step_factor", quantity, "", "0.8, or 0.5 where bonds can break",
             "the chosen time step over the stable limit, below 1", "0.5"},
        }, true, true},
        {"view", "[view]", Form::single, "What the pictures look like.", {
            {"size", size, "", "[1920, 1080]", "pixels, even numbers", "[1280, 720]"},
            {"colour", table, "colour", "", "what colours the particles",
             R"({ field = "von_mises", map = "viridis" })"},
            {"theme", choice, "", "dark", "", R"("light")", theme_names()},
            {"show", choices, "", "all of them", "what stands beside the picture", R"(["title", "time"])",
             View::all_parts()},
            {"window", points, "m", "the run up to separation",
             "two corners of the part of space that is shown",
             R"([["0 m", "0 m"], ["40 m", "20 m"]])"},
            {"background", choice, "", "theme",
             "transparent: none, in frames and in films of a format that has it (not mp4; gif without soft edges)",
             R"("transparent")", {"theme", "transparent"}},
            {"bonds", choice, "", "nearest", "which intact bonds are drawn", R"("all")", {"none", "nearest",
             "all"}},
            {"magnify", quantity, "", "1", "displacements are drawn this many times as large", "100"},
        }},
        {"colour", "colour", Form::inner, "What colours the particles.", {
            {"field", choice, "", "bond_strain", "", R"("von_mises")", scalar_field_names()},
            {"map", choice, "", "auto",
             "auto: diverging for a signed field in the range of the run, else inferno",
             R"("viridis")", map_choices()},
            {"range", range, "", "run",
             R"("run": what occurs during the run; or [low, high] in the unit of the field)",
             R"(["0 MPa", "20 MPa"])"},
        }},
        {"movie", "[movie]", Form::single, "The film.", {
            {"duration", quantity, "s", "12 s", "of the whole film, slow parts included", R"("8 s")"},
            {"fps", integer, "", "25", "frames per second", "30"},
            {"slow", tables, "slow", "[]", "slow motion; without it the failure gets a third of the film",
             R"([{ around = "first_break", span = "0.5 s", rate = 0.05 }])"},
            {"hold", quantity, "s", "a twelfth of duration", "how long the last picture stands, within duration",
             R"("1 s")"},
            {"flash", quantity, "s", "0.6 s", "playback time for which a fresh break is bright", R"("1 s")"},
            {"poster", moment, "", "two thirds of the breaks up to separation", "moment of poster.png",
             R"("peak_load")"},
            {"formats", choices, "", R"(["mp4"])",
             "of the film: movie.mp4, ...; the size of a gif is at most 960 pixels and 15 frames per second",
             R"(["mp4", "gif"])", film_formats()},
            {"gif_limit", quantity, "", "10", "MB; a gif becomes smaller, then slower, until it holds", "4"},
        }},
        {"slow", "slow", Form::inner, "One span of slow motion.", {
            {"around", moment, "", "required", "what is seen slowly; a fifth of the span comes before it",
             R"("first_break")"},
            {"span", quantity, "s", "required", "simulated time", R"("0.5 s")"},
            {"rate", quantity, "", "required", "speed relative to the rest of the film", "0.05"},
        }},
        {"strip", "[strip]", Form::single, "Key frames: the pictures of strip.png and of the report.", {
            {"at", moments, "", R"(["start", "first_break", "peak_load", "separation", "end"])",
             "moments; what did not happen is left out, what happened at once shares a picture",
             R"(["first_break", "separation", "separation + 0.2 s"])"},
        }},
        {"test", "[test]", Form::single, "Pictures that `hibi test` compares with stored ones.", {
            {"size", size, "", "[320, 180]", "pixels, even numbers", "[480, 270]"},
            {"frames", moments, "", R"(["start", "first_break", "peak_load", "separation", "end"])",
             "moments; what did not happen is left out, what happened at once shares a picture",
             R"(["first_break", "separation", "end"])"},
            {"params", names, "", "[]", "values of [params] for the test alone, as -p gives them: a coarser body, say",
             R"(["spacing=2 m"])"},
            {"tolerance", table, "tolerance", "", "limits of this scene, where the usual ones do not fit",
             "{ break_steps = 2 }"},
        }},
        {"tolerance", "tolerance", Form::inner, "Limits within which `hibi test` counts a scene as the same.", {
            {"tile", quantity, "", "3", "worst 32 x 32 tile: RMS difference of luma, in steps of 1/255", "4"},
            {"pixels", quantity, "", "8", "pixels per megapixel with a channel off by more than 16", "20"},
            {"mean", quantity, "", "0.6", "mean signed difference of any channel, in steps of 1/255", "1"},
            {"rmse", quantity, "", "1.5", "RMS difference of any channel, in steps of 1/255", "2"},
            {"position", quantity, "", "0.01", "difference of positions, in particle spacings", "0.1"},
            {"break_steps", integer, "", "0", "steps by which a bond may break earlier or later", "2"},
            {"load", quantity, "", "0.001", "difference of loads, in parts of the peak load", "0.01"},
        }},
        {"contact", "[contact]", Form::single, "Contact between bodies and fragments.", {}, false},
        {"rigid", "[[rigid]]", Form::list, "A rigid tool.", {}, false},
    };
    return blocks;
}
// clang-format on

}  // namespace hibi
