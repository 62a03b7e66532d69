#include "integrators/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "integrators/distance.hpp"
#include "integrators/frame.hpp"
#include "integrators/integrator.hpp"
#include "integrators/neighbour.hpp"
#include "lubrication/bristles.hpp"
#include "mesh/add_sums.hpp"
#include "model/equations.hpp"
#include "model/passages.hpp"
#include "model/set_step_constants.hpp"

namespace gearbox {

namespace {

constexpr double MISSED = 0.3;  // largest difference of states that agree [tolerances]
constexpr double LEFT = 30.0;   // difference after which a neighbouring run does not return
// Share of all periods since the last change for which the train must stay near its reference.
constexpr double SETTLED = 0.25;
// Parts of that stay, and of its least time, after which a neighbouring run starts, and after which
// the motion is not stable if that run has not approached it.
constexpr double EXAMINED = 0.25, REFUTED = 2.0;
// Part of its stay in which the neighbouring run must be near the train.
constexpr double JOINED = 0.25;

Instant now_of(const State& state) {
    return {state.seconds, state.time};
}

// Fill `place` with a state, relative to the start of the cycle.
void keep(const State& start, const State& state, Place& place) {
    place.state = state;
    place.after = delay(start, now_of(state));
    place.turned = state.turns[0] - start.turns[0] + (state.fraction[0] - start.fraction[0]);
    for (int e = 0; e < LEDGER; ++e) place.energy[e] = state.energy[e] - start.energy[e];
}

// Record the last step, unless there are too many steps or its modes are no longer stored.
void record_step(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const std::int64_t known = integrator.run.known.count(), place = periodic.steps;
    if (place == MOST_CYCLE_STEPS) periodic.cycles = 0;
    if (place == MOST_CYCLE_STEPS || known < periodic.known) {
        periodic.recording = false;
        return;
    }
    if (place == 0) {
        periodic.start = integrator.begin;
        periodic.coefficients.clear();
    }
    if (place == static_cast<std::int64_t>(periodic.cycle_steps.size()))
        periodic.cycle_steps.emplace_back();
    CycleStep& step = periodic.cycle_steps[place];
    keep(periodic.start, integrator.begin, step.begin);
    keep(periodic.start, integrator.end, step.end);
    step.collocated = integrator.control.collocated;
    std::memcpy(step.power, integrator.last.power, sizeof step.power);
    std::memcpy(step.friction_force, integrator.last.friction_force, sizeof step.friction_force);
    step.motion = integrator.run.motion;
    step.sums = integrator.sums.step;
    step.samples = {};
    if (model.train.durability.active) {
        periodic.passages.resize(place + 1);
        periodic.passages[place] = integrator.passages;
    }
    periodic.steps = place + 1;
    periodic.known = known;
}

// Adjust the end of the cycle to set-point and tooth positions; whether they agree.
bool close_cycle(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const Train& train = model.train;
    const State& end = integrator.end;
    Place& whole = periodic.whole;
    const std::int64_t motor = train.coupling.ends[0][0];
    keep(periodic.start, end, whole);
    double took = whole.after;
    double turned = whole.turned + end.x[motor] / train.body.radius[motor] / TURN;
    double turns =
        static_cast<double>(periodic.numerator) / static_cast<double>(periodic.denominator);
    whole.turned = std::copysign(turns, turned);
    whole.after = whole.turned * TURN / model.operation.target_speed[0];
    periodic.place = periodic.steps;
    periodic.part = 0;
    periodic.sums.time = 0.0;
    for (std::int64_t k = 0; k < periodic.steps; ++k)
        add_sums(periodic.cycle_steps[k].sums, periodic.sums, mesh_lanes(train));
    periodic.pairs_passed = std::exchange(periodic.sums.passed, {});
    const double sense = whole.turned * train.cycle.per_turn[0];
    periodic.advance = sense > 0.0 ? periodic.cycles : -periodic.cycles;
    periodic.ahead = 0;
    double late =
        std::max(std::fabs(took / whole.after - 1.0), std::fabs(turned / whole.turned - 1.0));
    return late * static_cast<double>(periodic.cycles) * PHASE <=
           MISSED * integrator.control.tolerance;
}

// Whether the train has stayed near the reference for this part of the time that is required.
bool has_stayed(const Periodic& periodic, const State& end, double part) {
    auto since = static_cast<double>(periodic.age - periodic.reference_age);
    return since >= part * SETTLED * static_cast<double>(periodic.age) &&
           delay(periodic.reference, now_of(end)) >= part * periodic.pause;
}

enum class Stability { UNKNOWN, STABLE, UNSTABLE };

// Follow the neighbouring run by a period in which the train has stayed near its reference.
Stability examine(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const State& end = integrator.end;
    if (periodic.neighbour.empty()) {
        if (has_stayed(periodic, end, EXAMINED)) start_neighbour(model, integrator);
        periodic.joined = 0;
        return Stability::UNKNOWN;
    }
    const double apart = follow_neighbour(model, integrator);
    if (apart > LEFT || has_stayed(periodic, end, REFUTED)) return Stability::UNSTABLE;
    periodic.joined = apart <= MISSED ? periodic.joined + 1 : 0;
    const auto since = static_cast<double>(periodic.age - periodic.reference_age);
    const bool has_joined = static_cast<double>(periodic.joined) >= JOINED * since;
    return has_joined && has_stayed(periodic, end, 1.0) ? Stability::STABLE : Stability::UNKNOWN;
}

// Change of the trim with which the speed loop meets a change of the loss of a period [J].
double trim_for(const Model& model, const Periodic& periodic, double change) {
    const Train& train = model.train;
    double torque = 0.0;  // along the rigid motion, per trim
    for (std::int64_t c = 0; c < train.machines; ++c)
        torque += train.body.ratio[0][train.coupling.ends[c][0]] * model.operation.trim_gain[c][0];
    const double turns =
        static_cast<double>(periodic.numerator) / static_cast<double>(periodic.denominator);
    const double angle = std::copysign(TURN * turns, model.operation.target_speed[0]);
    return torque == 0.0 ? 0.0 : change / (angle * torque);
}

// Trim train and neighbour for a period that loses `change` [J] more than those before the oil
// changed. The new motion is the reference, near which the train has stayed as long as before.
void move_reference(const Model& model, Integrator& integrator, double change) {
    Periodic& periodic = integrator.periodic;
    const double trim = trim_for(model, periodic, change);
    integrator.end.trim[0] += trim;
    for (Integrator& run : periodic.neighbour) run.end.trim[0] += trim;
    const Instant since = now_of(periodic.reference);
    periodic.reference = integrator.end;
    periodic.reference.seconds = since.seconds;
    periodic.reference.time = since.time;
}

// Go on after a small change of the oil, at the end of a period that lost `lost` [J].
void retune(const Model& model, Integrator& integrator, double lost) {
    Periodic& periodic = integrator.periodic;
    if (!periodic.neighbour.empty()) follow_neighbour(model, integrator);
    if (periodic.retuning == WAITS) {
        periodic.retuning = MEASURES;
        return;
    }
    move_reference(model, integrator, lost - periodic.loss);
    periodic.loss = lost;
    periodic.retuning = periodic.steady ? COMPARES : NOT_RETUNED;
    periodic.recording = periodic.steady;
    periodic.steps = periodic.known = 0;
}

// Losses [J] of the period that ends now.
double losses_of_period(Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const double before = periodic.loss_at_start;
    periodic.loss_at_start = losses_of(integrator.end.energy);
    return periodic.loss_at_start - before;
}

void check_repetition(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const State &end = integrator.end, &reference = periodic.reference;
    const double lost = losses_of_period(integrator);
    if (periodic.retuning == WAITS || periodic.retuning == MEASURES)
        return retune(model, integrator, lost);
    periodic.loss = lost;
    ++periodic.age;
    const bool near = same_contacts(model.train, end, reference) &&
                      distance(model, integrator.control, end, reference) <= MISSED;
    if (periodic.recording) {
        periodic.recording = false;
        periodic.replaying = near && close_cycle(model, integrator);
        periodic.retuning = NOT_RETUNED;
    } else if (near) {
        const Stability found =
            periodic.retuning == COMPARES ? Stability::STABLE : examine(model, integrator);
        if (found == Stability::UNKNOWN) return;
        periodic.recording = found == Stability::STABLE;
        periodic.steps = periodic.known = 0;
    } else {
        periodic.retuning = NOT_RETUNED;
    }
    periodic.neighbour.clear();
    periodic.reference_age = periodic.age;
    periodic.reference = end;
}

// Advance the start by one cycle; turns of the motor are counted in whole fractions.
void begin_cycle(Periodic& periodic) {
    State& start = periodic.start;
    const Place& whole = periodic.whole;
    run_on(start, start, whole.after);
    for (int e = 0; e < LEDGER; ++e) start.energy[e] += whole.energy[e];
    periodic.part += whole.turned > 0.0 ? periodic.numerator : -periodic.numerator;
    std::int64_t turns = periodic.part / periodic.denominator;
    if (periodic.part % periodic.denominator < 0) --turns;  // towards minus infinity
    periodic.part -= turns * periodic.denominator;
    start.turns[0] += static_cast<double>(turns);
    periodic.place = 0;
    periodic.ahead += periodic.advance;
}

// Start the cycle that contains `until`; earlier cycles are summed up as a whole.
void begin_cycle_of(Integrator& integrator, std::int64_t lanes, const Instant& until) {
    Periodic& periodic = integrator.periodic;
    const double end = periodic.cycle_steps[periodic.steps - 1].end.after;
    begin_cycle(periodic);
    const std::int64_t first = periodic.ahead;
    std::int64_t cycles = 0;
    for (; delay(periodic.start, until) > end; ++cycles) {
        integrator.control.repeated += periodic.steps;
        add_sums(periodic.sums, integrator.sums.total, lanes);
        begin_cycle(periodic);
    }
    if (cycles > 0)
        add_passed(periodic.pairs_passed, first, cycles, periodic.advance, integrator.sums.total);
}

// Set `state` to a place in the present cycle.
void restore(const Periodic& periodic, const Place& place, State& state) {
    const State& start = periodic.start;
    state = place.state;
    run_on(start, state, place.after);
    Turns turns = turns_at(periodic, place);
    state.turns[0] = turns.whole;
    state.fraction[0] = turns.fraction;
    for (int e = 0; e < LEDGER; ++e) state.energy[e] = start.energy[e] + place.energy[e];
}

}  // namespace

CycleStep& replayed_step(Periodic& periodic) {
    return periodic.cycle_steps[periodic.place - 1];
}

Turns turns_at(const Periodic& periodic, const Place& place) {
    const State& start = periodic.start;
    double part = static_cast<double>(periodic.part) / static_cast<double>(periodic.denominator);
    double turns = start.fraction[0] + place.turned + part, whole = std::floor(turns);
    return {start.turns[0] + whole, turns - whole};
}

CycleStep& following_step(Periodic& periodic) {
    if (periodic.place == periodic.steps) begin_cycle(periodic);
    return periodic.cycle_steps[periodic.place++];
}

void add_replayed(const Train& train, const CycleStep& step, Integrator& integrator) {
    MeshSums& total = integrator.sums.total;
    const std::size_t before = total.passed.size();
    add_sums(step.sums, total, mesh_lanes(train));
    total.passed.resize(before);
    add_passed(step.sums.passed, integrator.periodic.ahead, 1, 0, total);
}

CycleStep& next_step(const Model& model, Integrator& integrator, const Instant& until) {
    Periodic& periodic = integrator.periodic;
    while (true) {
        if (periodic.place == periodic.steps)
            begin_cycle_of(integrator, mesh_lanes(model.train), until);
        CycleStep& step = following_step(periodic);
        ++integrator.control.repeated;
        if (delay(periodic.start, until) <= step.end.after) return step;
        add_replayed(model.train, step, integrator);
    }
}

void check_periodicity(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    if (periodic.cycles == 0) return;
    if (periodic.recording) record_step(model, integrator);
    if (!begins_mesh_cycle(integrator)) return;
    if (++periodic.passed < periodic.cycles) return;
    periodic.passed = 0;
    check_repetition(model, integrator);
}

void restart_settling(Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    periodic.age = periodic.reference_age = periodic.passed = 0;
    periodic.recording = periodic.replaying = false;
    periodic.retuning = NOT_RETUNED;
    periodic.neighbour.clear();
}

void cut_for_oil(const Model& model, Integrator& integrator, const Instant& now) {
    Periodic& periodic = integrator.periodic;
    const bool begins_again = delay(integrator.end, now) < 0.0 && begins_mesh_cycle(integrator);
    const bool steady = periodic.replaying || periodic.recording;
    // Losses of motion that is not near its reference vary by themselves. At the first check after
    // a change, less than a period has passed.
    const bool settling = periodic.retuning == NOT_RETUNED &&
                          periodic.age > std::max<std::int64_t>(periodic.reference_age, 1);
    if (model.train.axes > 1 || !(steady || settling)) return cut(model, integrator, now);
    if (periodic.replaying) periodic.loss = losses_of(periodic.whole.energy);
    const std::int64_t age = periodic.age, reference_age = periodic.reference_age,
                       joined = periodic.joined, passed = periodic.passed;
    std::vector<Integrator> neighbour = std::move(periodic.neighbour);
    cut(model, integrator, now);
    periodic.retuning = WAITS;
    periodic.steady = steady;
    if (steady) return;
    periodic.age = age;
    periodic.reference_age = reference_age;
    periodic.joined = joined;
    // The period remains that of the neighbour.
    periodic.passed = (passed + (begins_again ? periodic.cycles - 1 : 0)) % periodic.cycles;
    periodic.neighbour = std::move(neighbour);
}

double losses_of(const double* energy) {
    double lost = 0.0;
    for (int s = 0; s < HEATS; ++s) lost += energy[HEAT + s];
    return lost;
}

void stand_at(const Model& model, Integrator& integrator, const CycleStep& step) {
    const Periodic& periodic = integrator.periodic;
    restore(periodic, step.begin, integrator.begin);
    restore(periodic, step.end, integrator.end);
    integrator.control.collocated = step.collocated;
    integrator.control.step = step.end.after - step.begin.after;
    std::memcpy(integrator.last.power, step.power, sizeof step.power);
    std::memcpy(integrator.last.friction_force, step.friction_force, sizeof step.friction_force);
    integrator.run.motion = step.motion;
    const State& begin = integrator.begin;
    set_step_constants(model, begin, integrator.constants);
    if (step.collocated) return;  // otherwise dense output computes the step again
    place_bristles(integrator.first.pairs, begin.bristle);
    forces(model, begin, integrator.constants, begin.x, begin.v, 0.0, begin.trim, integrator.first);
}

void continue_from(const Model& model, Integrator& integrator, const CycleStep& step) {
    const Periodic& periodic = integrator.periodic;
    stand_at(model, integrator, step);
    integrator.sums.step = step.sums;
    integrator.sums.step.passed.clear();
    add_passed(step.sums.passed, periodic.ahead, 1, 0, integrator.sums.step);
    if (!model.train.durability.active) return;
    integrator.passages = periodic.passages[&step - periodic.cycle_steps.data()];
    renumber(model.train, integrator.begin, integrator.constants, integrator.passages);
}

}  // namespace gearbox
