#include "studies/verify_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "measure/closed_form.hpp"
#include "measure/modal_displacement.hpp"

namespace hibi {

double VerifyRun::parameter(const std::string& name) const {
    for (const Parameter& p : scene.params)
        if (p.name == name) return p.value;
    throw std::logic_error("no parameter " + name);
}

double VerifyRun::displacement(const std::string& load) const {
    for (std::size_t l = 0; l < scene.loads.size(); ++l)
        if (scene.loads[l].name == load) return observations.back().row.displacements[l];
    throw std::logic_error("no load " + load);
}

namespace {

VerifyResult compare(double measured, double reference) {
    return {measured, reference, std::abs(measured / reference - 1)};
}

const Material& material(const VerifyRun& run) { return run.scene.materials[0]; }

/// As a theory of plane stress sees the material.
PlaneConstants plane_constants(const VerifyRun& run) {
    const auto& [E, nu] = std::pair(material(run).youngs_modulus, material(run).poissons_ratio);
    return run.scene.assumption == Assumption::plane_strain ? plane_strain(E, nu) : PlaneConstants{E, nu};
}

/// The bar is measured between the centres of its end columns.
VerifyResult judge_bar(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    return compare(run.displacement("left") + run.displacement("right"),
                   run.parameter("stress") / material(run).youngs_modulus *
                       (run.parameter("length") - run.parameter("spacing")));
}

VerifyResult judge_cantilever(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    const double L = run.parameter("length");
    return compare(run.displacement("tip"),
                   cantilever_displacement(L, 0, run.parameter("force"), L, run.parameter("height"),
                                           plane_constants(run))
                       .y());
}

double period(const VerifyRun& run) {
    std::vector<double> times, displacement;
    for (const VerifyObservation& o : run.observations) {
        times.push_back(o.row.time);
        displacement.push_back(o.modal_displacement);
    }
    return period_of(times, displacement).value_or(std::nan(""));
}

VerifyResult judge_free_beam(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    return compare(period(run), free_free_period({run.parameter("length"), run.parameter("height"),
                                                  run.parameter("density"), plane_constants(run)}));
}

VerifyResult judge_wave(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    return compare(period(run), bar_period(run.parameter("length"), run.parameter("height"),
                                           run.parameter("density"), plane_constants(run)));
}

/// From the centres of the clamped column nearest to the plate, which lie half a spacing behind x = 0.
VerifyResult judge_clamped_plate(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    return compare(period(run), clamped_plate_period(run.parameter("length") + run.parameter("spacing") / 2,
                                                     run.parameter("height"), run.parameter("youngs"),
                                                     run.parameter("density")));
}

/// The worst of the loads; its error is a share of the beam's length, as the elastica has no other.
VerifyResult judge_elastica(const std::vector<VerifyRun>& runs) {
    VerifyResult worst;
    for (const VerifyRun& run : runs) {
        const double across = run.displacement("tip") / run.parameter("span");
        const double reference = elastica_end(run.parameter("load")).y();
        if (const double error = std::abs(across - reference); !(error < worst.error))
            worst = {across, reference, error};
    }
    return worst;
}

/// Energy rises and falls by itself within a step's length; what must not change is its mean. The last tenth
/// of the run against the first.
VerifyResult judge_energy(const std::vector<VerifyRun>& runs) {
    const std::vector<VerifyObservation>& all = runs[0].observations;
    const std::size_t tenth = std::max<std::size_t>(1, all.size() / 10);
    const auto mean = [&](std::size_t begin) {
        double sum = 0;
        for (std::size_t k = begin; k < begin + tenth; ++k) sum += all[k].row.kinetic + all[k].row.elastic;
        return sum / static_cast<double>(tenth);
    };
    return compare(mean(all.size() - tenth), mean(0));
}

VerifyResult judge_angular_momentum(const std::vector<VerifyRun>& runs) {
    const std::vector<VerifyObservation>& all = runs[0].observations;
    VerifyResult worst;
    for (const VerifyObservation& o : all)
        if (const VerifyResult r = compare(o.angular_momentum, all[0].angular_momentum);
            !(r.error < worst.error))
            worst = r;
    return worst;
}

/// Stress at first break (Pa); not a number where nothing broke.
double first_break_stress(const VerifyRun& run, double section) {
    return run.events.first_break ? run.events.first_break->load / section : std::nan("");
}

/// Stress under which the crack has run on by three spacings (Pa): the first bond alone does not let it go.
double running_stress(const VerifyRun& run, double section) {
    for (const VerifyObservation& o : run.observations)
        if (o.row.crack.length >= 3 * run.parameter("spacing")) return o.row.load / section;
    return std::nan("");
}

VerifyResult judge_cracked_strip(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    const double a = run.parameter("crack"), W = run.parameter("width");
    return compare(running_stress(run, W), std::sqrt(material(run).youngs_modulus * run.parameter("energy") /
                                                     (std::numbers::pi * a)) /
                                               edge_crack_factor(a / W));
}

VerifyResult judge_flawless_bar(const std::vector<VerifyRun>& runs) {
    const VerifyRun& run = runs[0];
    return compare(first_break_stress(run, run.parameter("height")),
                   material(run).youngs_modulus * run.parameter("limit"));
}

constexpr const char* statics = "At rest";
constexpr const char* vibrations = "Vibrations";
constexpr const char* conservation = "Conservation";
constexpr const char* failure = "Failure";

}  // namespace

const std::vector<VerifyCase>& verify_cases() {
    static const std::vector<VerifyCase> cases{
        {.id = "bar",
         .title = "Bar in tension",
         .group = statics,
         .scene = "verify/bar",
         .parameter = "rows",
         .quantity = "extension",
         .unit = "m",
         .reference = "F L / (E A)",
         .resolutions = {{5, 1e-3, true}, {10, 1e-3, true}, {20, 1e-3}},
         .judge = judge_bar},
        {.id = "cantilever",
         .title = "Cantilever",
         .group = statics,
         .scene = "verify/cantilever",
         .parameter = "rows",
         .quantity = "deflection",
         .unit = "m",
         .reference = "plane stress, Timoshenko and Goodier, art. 21",
         .resolutions = {{5, 1.5e-2, true}, {10, 5e-3, true}, {20, 2e-3}, {40, 1e-3, false, false}},
         .judge = judge_cantilever},
        {.id = "cantilever_incompressible",
         .title = "Cantilever, nu 0.49",
         .group = statics,
         .scene = "verify/cantilever_incompressible",
         .parameter = "rows",
         .quantity = "deflection",
         .unit = "m",
         .reference = "plane strain, Timoshenko and Goodier, art. 21",
         .resolutions =
             {{5, {}, true}, {7, {}}, {10, 5e-3}, {20, 5e-3, false, false}, {40, 5e-3, false, false}},
         .judge = judge_cantilever},
        {.id = "elastica",
         .title = "Elastica",
         .group = statics,
         .scene = "verify/elastica",
         .parameter = "rows",
         .quantity = "deflection over length",
         .unit = "",
         .reference = "elliptic integrals, Bisshopp and Drucker 1945; the worst of four loads",
         .resolutions = {{2, {}, true}, {3, {}}, {4, 1e-2}, {8, 1e-2, true, false}},
         .judge = judge_elastica,
         .overrides = {{{"load", "1"}}, {{"load", "2"}}, {{"load", "5"}}, {{"load", "10"}}}},
        {.id = "free_beam",
         .title = "Free beam",
         .group = vibrations,
         .scene = "verify/free_beam",
         .parameter = "rows",
         .quantity = "period",
         .unit = "s",
         .reference = "Timoshenko's beam theory, shear coefficient of Cowper 1966",
         .resolutions = {{4, 2e-2, true}, {8, 1e-3, true}, {16, 1e-3}},
         .judge = judge_free_beam},
        {.id = "bar_wave",
         .title = "Wave in a bar",
         .group = vibrations,
         .scene = "verify/bar_wave",
         .parameter = "particles",
         .quantity = "period",
         .unit = "s",
         .reference = "2 L / sqrt(E / rho), with Love's correction for lateral inertia",
         .resolutions = {{20, {}, true}, {40, 1e-3, true}, {80, 1e-3, true}, {160, 1e-3}},
         .judge = judge_wave},
        {.id = "clamped_plate",
         .title = "Clamped plate",
         .group = vibrations,
         .scene = "verify/clamped_plate",
         .parameter = "rows",
         .quantity = "period",
         .unit = "s",
         .reference = "converged plane solution",
         .resolutions = {{5, 1e-2, true}, {10, 1e-2, true}, {20, 1e-2}},
         .judge = judge_clamped_plate},
        {.id = "spin_energy",
         .title = "Free spin, energy",
         .group = conservation,
         .scene = "verify/free_spin",
         .parameter = "factor",
         .quantity = "mean energy",
         .unit = "J",
         .reference = "that of the first tenth of the run",
         .resolutions = {{0.9, 2e-4, true}, {0.7, 2e-4}, {0.5, 5e-5}},
         .judge = judge_energy,
         .observations = 4000},
        {.id = "spin_angular_momentum",
         .title = "Free spin, angular momentum",
         .group = conservation,
         .scene = "verify/free_spin",
         .parameter = "factor",
         .quantity = "angular momentum",
         .unit = "kg m^2/s",
         .reference = "that of the start",
         .resolutions = {{0.9, 1e-12}, {0.7, 1e-12}, {0.5, 1e-12}},
         .judge = judge_angular_momentum},
        {.id = "cracked_strip",
         .title = "Strip with an edge crack",
         .group = failure,
         .scene = "verify/cracked_strip",
         .parameter = "columns",
         .quantity = "stress that the crack runs under",
         .unit = "Pa",
         .reference = "K = F sigma sqrt(pi a), Tada, Paris and Irwin",
         .resolutions = {{10, 5e-2, true}, {20, 5e-2, true}, {40, 5e-2}},
         .judge = judge_cracked_strip,
         .observations = 1000},
        {.id = "flawless_bar",
         .title = "Flawless bar",
         .group = failure,
         .scene = "verify/flawless_bar",
         .parameter = "rows",
         .quantity = "stress at first break",
         .unit = "Pa",
         .reference = "E times break_strain",
         .resolutions = {{5, 2e-2, true}, {10, 2e-2, true}, {20, 2e-2}},
         .judge = judge_flawless_bar},
    };
    return cases;
}

}  // namespace hibi
