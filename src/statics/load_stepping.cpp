#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ranges>

#include "base/units.hpp"
#include "loads/applied_loads.hpp"
#include "statics/load_stepping.hpp"

namespace hibi {

namespace {

/// A load step that does not converge is made in parts, down to this one.
constexpr double smallest_part = 1.0 / 64;
/// Times its length to which a bond may be squeezed or stretched: no solid stands more, so the search for
/// such an equilibrium is not worth its time.
constexpr double shortest = 0.1, longest = 4;

}  // namespace

template <int Dim>
LoadStepping<Dim>::LoadStepping(const Model<Dim>& model, const Physics& physics,
                                Interactions<Dim>& interactions, State<Dim>& state)
    : model_(model),
      physics_(physics),
      interactions_(interactions),
      breaking_(interactions.template find<Breaking<Dim>>()) {
    load_time_ = state.remember("load time", 1);
    settled_ = state.remember("settled", 1, 1);
    fragment_ = state.remember("fragment", model.particles.count());
    buckled_ = state.remember("buckled", 1);
    flags_ = state.remember("factor", 3);
    factor_displacement_ = state.remember("factor, displacement", 0);
    factor_intact_ = state.remember("factor, intact bonds", 0);
    stiffness_ = state.remember("factor, diagonal", 0);
    softest_ = state.remember("softest mode", 0);
    softest_image_ = state.remember("softest mode, image", 0);
    for (Vec<Dim>& v : state.velocity) v.setZero();
    equilibrium_.emplace(model_, interactions_.elastic().law(), state,
                         held_or_driven(model_.particles.count(), physics_));
    start(state);
    remember(state);
}

/// Everything that acts at t = 0, weight above all, is raised from nothing.
template <int Dim>
void LoadStepping<Dim>::start(State<Dim>& state) {
    interactions_.update_and_sum_forces(state);
    const State<Dim> before = state;
    double done = 0, part = 1;
    while (done < 1 && state.collapse.empty()) {
        const Settled settled = settle(state, 0, Search::stable_equilibrium, done + part);
        if (settled.found)
            done += part;
        else
            part /= 2;
        if (part < smallest_part)
            state.collapse = collapse_message(
                state,
                fmt::format("under {:.3g} % of what acts from the first moment on (gravity, and loads "
                            "without a ramp)",
                            100 * (done + smallest_part)),
                settled, "a smaller load, or less gravity");
        part = std::min(part, 1 - done);
    }
    count_work(before, state, false);
}

/// Writes what the search for equilibrium keeps to the State.
template <int Dim>
void LoadStepping<Dim>::remember(State<Dim>& state) {
    const auto copy = [&](int memory, const auto& from) { state.memory(memory).assign(from.begin(), from.end()); };
    const typename Equilibrium<Dim>::Memory& memory = equilibrium_->memory();
    copy(flags_, std::array<double, 3>{double(memory.factorised), memory.shift, double(memory.knows_softest)});
    std::vector<double>& displacement = state.memory(factor_displacement_);
    displacement.clear();
    for (const Vec<Dim>& u : memory.displacement) displacement.insert(displacement.end(), u.begin(), u.end());
    copy(factor_intact_, memory.intact);
    copy(stiffness_, memory.stiffness);
    copy(softest_, memory.softest);
    copy(softest_image_, memory.softest_image);
}

template <int Dim>
void LoadStepping<Dim>::rebuild(const State<Dim>& state) {
    equilibrium_.emplace(model_, interactions_.elastic().law(), initial_state(model_),
                         held_or_driven(model_.particles.count(), physics_));
    for (int i = 0; i < model_.particles.count(); ++i)
        if (is_fragment(state, i)) equilibrium_->hold(i);
    const auto vector = [&](int memory) {
        const std::vector<double>& values = state.memory(memory);
        return Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size())).eval();
    };
    typename Equilibrium<Dim>::Memory memory;
    memory.factorised = state.memory(flags_)[0] != 0;
    memory.shift = state.memory(flags_)[1];
    memory.knows_softest = state.memory(flags_)[2] != 0;
    const Eigen::VectorXd displacement = vector(factor_displacement_);
    for (int i = 0; i < model_.particles.count(); ++i)
        memory.displacement.push_back(displacement.template segment<Dim>(Dim * i));
    memory.intact.assign(state.memory(factor_intact_).begin(), state.memory(factor_intact_).end());
    memory.stiffness = vector(stiffness_);
    memory.softest = vector(softest_);
    memory.softest_image = vector(softest_image_);
    equilibrium_->restore(state, std::move(memory));
}

/// Equilibrium at the present load after bonds have broken; or the next load, at which the first bond breaks
/// or the load step ends; then bonds are judged.
template <int Dim>
void LoadStepping<Dim>::step(State<Dim>& state) {
    ++state.step;
    if (breaking_) breaking_->begin_step(state);
    if (!state.collapse.empty()) return;
    const std::vector<std::string> names = stage_names();
    {
        const TimedStage timed(this->profile_, names[1].c_str());
        if (!settled(state))
            relax(state);
        else if (highest_utilisation(state) <= 1)
            raise_loads(state);
    }
    if (state.collapse.empty() && breaking_) {
        const TimedStage timed(this->profile_, names.back().c_str());
        break_overstrained(state);
    }
    remember(state);
}

/// Equilibrium again at the same load, after breaks. Where bonds break one by one and there is none that all
/// bear, the body goes towards it only until the next one breaks: a part that is being torn off would
/// otherwise be drawn out by its last bonds to many times its length.
template <int Dim>
void LoadStepping<Dim>::relax(State<Dim>& state) {
    const State<Dim> before = state;
    pause(state);
    Settled result = settle(state, load_time(state), Search::stable_equilibrium);
    if (breaking_ && physics_.statics->sequential && (!result.found || highest_utilisation(state) > 1)) {
        if (result.found) go_back_to(state, before);
        // The way down the energy is the nearest there is to what the body would do.
        result = settle(state, load_time(state), Search::next_break);
        if (result.stopped) go_back_to_next_break(state);
    }
    settled(state) = true;
    if (result.found || result.stopped)
        count_work(before, state, false);
    else
        state.collapse = collapse_message(
            state, fmt::format("after the break at t = {}", format_si(load_time(state), "s", 4)), result, "");
}

/// `way_out`: what to try instead; before the first break only, since later a collapse is an outcome.
template <int Dim>
std::string LoadStepping<Dim>::collapse_message(const State<Dim>& state, const std::string& when,
                                                const Settled& settled, const std::string& way_out) const {
    std::string text = fmt::format("no equilibrium {}", when);
    if (const int i = settled.gave_way; i >= 0)
        text += fmt::format(
            ": body \"{}\" {}, most of all at {}", model_.bodies[model_.particles.body[i]].name,
            settled.senseless ? "is crushed, stretched or flung beyond what a linear law can stand for"
                              : "gives way",
            place_text(i));
    if (state.broken > 0 || way_out.empty()) return text;
    if (settled.senseless)
        return text + fmt::format(
                          "; the loads may be far too large for the material: are their units and "
                          "that of youngs_modulus right? If so, try {}{}",
                          way_out, breaking_ ? "" : ", or give the material a break_strain");
    text += fmt::format("; it buckles, or bears no more: try {}; method = \"explicit\" shows the motion",
                        way_out);
    return state.instability.empty() ? text : text + "; " + state.instability;
}

template <int Dim>
std::string LoadStepping<Dim>::place_text(int particle) const {
    const Vec3 X = to_3d<Dim>(model_.particles.reference_position[particle]);
    return fmt::format("({:.4g}, {:.4g}) m", X.x(), X.y());
}

/// `share` of the loads; the way led from one time of the loads to another.
template <int Dim>
void LoadStepping<Dim>::note_instability(State<Dim>& state, const Settled::Unstable& unstable, double from,
                                         double to, double share) const {
    const double time = from + unstable.share * (to - from);
    std::string text = fmt::format("equilibrium became unstable at t = {}", format_si(time, "s", 4));
    if (to == 0) text = fmt::format("equilibrium is unstable under {:.3g} % of the first loads", 100 * share);
    for (const Load& load : physics_.loads) {
        if (to == 0 || !load.primary || load.share.empty()) continue;
        text += fmt::format(", under a load of {}",
                            format_si(std::abs(total_applied(model_, load, time)), "N", 4));
    }
    const int i = unstable.particle;
    state.instability = text + fmt::format(": body \"{}\" buckles, most of all at {}",
                                      model_.bodies[model_.particles.body[i]].name, place_text(i));
}

template <int Dim>
void LoadStepping<Dim>::raise_loads(State<Dim>& state) {
    const double step = physics_.statics->step();
    const double next = (std::floor(state.time / step * (1 + 1e-12) + 1e-12) + 1) * step;
    const double lower = highest_utilisation(state);
    const State<Dim> before = state;
    smooth_ = true;
    const Settled failed = approach(state, next);
    if (const double upper = highest_utilisation(state); upper > 1)
        find_first_break(state, before, lower, upper);
    else if (load_time(state) < next)
        state.collapse = collapse_message(
            state,
            fmt::format("found between the loads at t = {} and {}", format_si(load_time(state), "s", 4),
                        format_si(load_time(state) + smallest_part * (next - load_time(before)), "s", 4)),
            failed, "more load_steps or a smaller load");
    count_work(before, state, smooth_);
    if (load_time(state) > state.time)
        state.time = load_time(state);
    else
        pause(state);
}

/// The load stands still, and falls behind the time; the next load step catches up.
template <int Dim>
void LoadStepping<Dim>::pause(State<Dim>& state) const {
    const double left = physics_.statics->duration - state.time, pause = physics_.statics->pause();
    state.time += left > 0 ? std::min(pause, left / 4) : pause;
}

/// Raises the loads as far as there is equilibrium, in parts if need be. Returns the last search that failed,
/// if one did.
template <int Dim>
Settled LoadStepping<Dim>::approach(State<Dim>& state, double to) {
    const double from = load_time(state);
    double done = 0, part = 1;
    Settled failed;
    while (done < 1 && part >= smallest_part) {
        const double next = done + part < 1 ? from + (done + part) * (to - from) : to;
        const Settled result = settle(state, next, Search::stable_equilibrium);
        if (result.found) {
            done += part;
            part = std::min(2 * part, 1 - done);
        } else {
            part /= 2;
            failed = result;
        }
    }
    return failed;
}

/// Equilibrium under a share of the loads of that time. Where there is none, nothing is changed.
template <int Dim>
Settled LoadStepping<Dim>::settle(State<Dim>& state, double time, Search search, double share) {
    const int n = model_.particles.count();
    const std::vector<Vec<Dim>> start = state.displacement;
    StaticLoads<Dim> loads{std::vector<Vec<Dim>>(n, Vec<Dim>::Zero()),
                           std::vector<Vec<Dim>>(n, Vec<Dim>::Zero())};
    for (const auto& interaction : interactions_) interaction->add_static_loads(state, time, share, loads);
    if (std::ranges::none_of(physics_.loads, &Load::prescribes_motion)) loads.moved.clear();
    // Bonds that break all together may be torn to any length before they do.
    const bool sensible = state.broken == 0 || physics_.statics->sequential;
    int senseless = -1;
    const auto enough = [&] {
        if (search == Search::next_break) return highest_utilisation(state) > 1;
        if (sensible) senseless = senseless_bond(state);
        return senseless >= 0;
    };
    Settled result = search == Search::stable_equilibrium ? equilibrium_->find_stable(state, loads, enough)
                                                          : equilibrium_->find(state, loads, enough);
    if (senseless >= 0) {
        state.displacement = start;
        result.stopped = false;
        result.senseless = true;
        result.gave_way = model_.bonds.first[senseless];
    }
    double& buckled = state.memory(buckled_)[0];
    if (result.unstable && state.broken == 0 && !buckled) {
        note_instability(state, *result.unstable, load_time(state), time, share);
        buckled = result.found;
    }
    if (result.found) {
        for (const auto& interaction : interactions_) interaction->take_static_loads(state, time, share);
        load_time(state) = time;
        smooth_ = smooth_ && result.smooth;
    }
    interactions_.update_and_sum_forces(state);
    return result;
}

/// The first bond that is squeezed or stretched beyond sense, or -1.
template <int Dim>
int LoadStepping<Dim>::senseless_bond(const State<Dim>& state) const {
    const Bonds& bonds = model_.bonds;
    const std::vector<Vec<Dim>>& X = model_.particles.reference_position;
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        if (!state.is_intact(b) || is_fragment(state, i)) continue;
        const Vec<Dim> r0 = X[j] - X[i];
        const double times =
            (r0 + state.displacement[j] - state.displacement[i]).squaredNorm() / r0.squaredNorm();
        if (!(times >= shortest * shortest && times <= longest * longest)) return b;
    }
    return -1;
}

/// To an equilibrium of the same step. What time, accounts and notes say of the way stays.
template <int Dim>
void LoadStepping<Dim>::go_back_to(State<Dim>& state, const State<Dim>& earlier) {
    state.displacement = earlier.displacement;
    const double buckled = state.memory(buckled_)[0];
    state.memories = earlier.memories;
    state.memory(buckled_)[0] = buckled;
    interactions_.update_and_sum_forces(state);
}

/// Work of loads and prescribed motion by the trapezoidal rule. On a smooth path that leaves a balance to be
/// checked; otherwise, after a break or a snap, what the elastic energy lacks was lost on the way. Where it
/// has more than the rule knows of, the work was done late in the step, under more load: beyond a buckling
/// load.
template <int Dim>
void LoadStepping<Dim>::count_work(const State<Dim>& before, State<Dim>& now, bool smooth) {
    // Dead loads before prescribed motion: the last digit of the sum depends on the order.
    for (const auto& interaction : std::views::reverse(interactions_))
        interaction->add_static_work(before, now);
    if (smooth) return;
    const Energies then = interactions_.energies(before), here = interactions_.energies(now);
    const double lost = (here.work - then.work) - (here.elastic - then.elastic);
    (lost > 0 ? now.energies.damped : now.energies.work) += std::abs(lost);
}

template <int Dim>
std::vector<std::string> LoadStepping<Dim>::stage_names() const {
    std::vector<std::string> names{breaking_ ? "raise loads, to the next load step or to the first break"
                                             : "raise loads to the next load step",
                                   "equilibrium (Newton, moment-matched)"};
    if (breaking_)
        names.push_back(physics_.statics->sequential ? "break the bond furthest beyond its limit"
                                                     : "break all bonds beyond their limits");
    return names;
}

template class LoadStepping<2>;

}  // namespace hibi
