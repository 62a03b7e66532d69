#include "integrators/periodic.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "integrators/frame.hpp"
#include "mesh/add_sums.hpp"
#include "mesh/deflection.hpp"
#include "train/body_speed.hpp"
#include "train/equations.hpp"
#include "train/set_step_constants.hpp"
#include "tribology/bristles.hpp"

namespace gearbox {

namespace {

constexpr std::int64_t MOST_CYCLE_STEPS = 4096;  // largest number of steps in a cycle
// Largest difference of states one cycle apart, relative to the tolerance.
constexpr double MISSED_SHARE = 0.3;
constexpr double SETTLED = 0.25;  // share of all cycles in which states must agree
// Change of the transmission errors, in static deflections, by a delay of one mesh cycle.
constexpr double PHASE = 20.0;

Instant now_of(const State& state) {
    return {state.seconds, state.time};
}

// Whether a mesh cycle starts at the end of the step.
bool begins_mesh_cycle(const Integrator& integrator) {
    const State &begin = integrator.begin, &end = integrator.end;
    return begin.segment[0] != 0 && end.segment[0] == 0 && end.side[0] != OPEN;
}

bool same_contacts(const Train& train, const State& a, const State& b) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        if (a.side[i] != b.side[i] || a.segment[i] != b.segment[i]) return false;
    return true;
}

// Difference of two states in meshes, couplings and speeds, as a deflection of the meshes [m].
double distance_of_bodies(const Train& train, const Control& control, const State& a,
                          const State& b) {
    double largest = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i)
        largest =
            std::max(largest, std::fabs(mesh_motion(train, i, a.x) - mesh_motion(train, i, b.x)));
    double stiffness = std::min(train.stiffness[0], train.stiffness[1]);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t p = train.coupling[c][0], q = train.coupling[c][1];
        double twist = a.x[p] - a.x[q] - b.x[p] + b.x[q];
        largest = std::max(largest, std::fabs(twist) * train.coupling_stiffness[c] / stiffness);
    }
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double speed = body_speed(train, a, a.v, j) - body_speed(train, b, b.v, j);
        largest =
            std::max(largest, std::fabs(speed) * train.radius[j] / control.speed_per_deflection);
    }
    return largest;
}

// Difference of two states as a deflection of the meshes, relative to the static deflection.
double distance(const Model& model, const Integrator& integrator, const State& a, const State& b) {
    const Train& train = model.train;
    const Control& control = integrator.control;
    constexpr double apart = std::numeric_limits<double>::infinity();
    if (!same_contacts(train, a, b)) return apart;
    double largest = distance_of_bodies(train, control, a, b);
    for (std::int64_t k = 0; k < train.axes; ++k) {
        double target = model.load.target_speed[k];
        if (a.set_speed[k] != target || b.set_speed[k] != target) return apart;
        double late = (a.trim[k] - b.trim[k]) * train.cycles[k] / TURN;
        largest = std::max(largest, std::fabs(late) * PHASE * control.deflection);
    }
    if (control.creeping)
        for (std::int64_t k = 0; k < train.slots * train.meshes; ++k)
            largest =
                std::max(largest, std::fabs(a.bristle[k] - b.bristle[k]) * control.deflection);
    return largest / control.deflection;
}

// Fill `place` with a state, relative to the start of the cycle.
void keep(const State& start, const State& state, Place& place) {
    place.state = state;
    place.after = delay(start, now_of(state));
    place.turned = state.turns[0] - start.turns[0] + (state.fraction[0] - start.fraction[0]);
    for (int e = 0; e < LEDGER; ++e) place.energy[e] = state.energy[e] - start.energy[e];
}

// Record the last step, unless there are too many steps or its modes are no longer stored.
void record_step(Integrator& integrator) {
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
    periodic.steps = place + 1;
    periodic.known = known;
}

// Adjust the end of the cycle to set-point and tooth positions; whether they agree.
bool close_cycle(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const Train& train = model.train;
    const State& end = integrator.end;
    Place& whole = periodic.whole;
    const std::int64_t motor = train.coupling[0][0];
    keep(periodic.start, end, whole);
    double took = whole.after;
    double turned = whole.turned + end.x[motor] / train.radius[motor] / TURN;
    double turns =
        static_cast<double>(periodic.numerator) / static_cast<double>(periodic.denominator);
    whole.turned = std::copysign(turns, turned);
    whole.after = whole.turned * TURN / model.load.target_speed[0];
    periodic.place = periodic.steps;
    periodic.part = 0;
    periodic.sums.time = 0.0;
    for (std::int64_t k = 0; k < periodic.steps; ++k)
        add_sums(periodic.cycle_steps[k].sums, periodic.sums, mesh_lanes(train));
    double late =
        std::max(std::fabs(took / whole.after - 1.0), std::fabs(turned / whole.turned - 1.0));
    return late * static_cast<double>(periodic.cycles) * PHASE <=
           MISSED_SHARE * integrator.control.tolerance;
}

// Whether the train has stayed near the reference for long enough to repeat.
bool has_settled(const Periodic& periodic, const State& end) {
    auto since = static_cast<double>(periodic.age - periodic.reference_age);
    double stayed = delay(periodic.reference, now_of(end));
    return !(since < SETTLED * static_cast<double>(periodic.age) || stayed < periodic.pause);
}

void check_repetition(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    const State& end = integrator.end;
    ++periodic.age;
    bool near = distance(model, integrator, end, periodic.reference) <=
                MISSED_SHARE * integrator.control.tolerance;
    if (periodic.recording) {
        periodic.recording = false;
        periodic.replaying = near && close_cycle(model, integrator);
    } else if (near) {
        if (!has_settled(periodic, end)) return;
        periodic.recording = true;
        periodic.steps = periodic.known = 0;
    }
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
}

// Start the cycle that contains `until`; earlier cycles are summed up as a whole.
void begin_cycle_of(Integrator& integrator, std::int64_t lanes, const Instant& until) {
    Periodic& periodic = integrator.periodic;
    const double end = periodic.cycle_steps[periodic.steps - 1].end.after;
    begin_cycle(periodic);
    while (delay(periodic.start, until) > end) {
        integrator.control.repeated += periodic.steps;
        add_sums(periodic.sums, integrator.sums.total, lanes);
        begin_cycle(periodic);
    }
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

CycleStep& next_step(const Model& model, Integrator& integrator, const Instant& until) {
    Periodic& periodic = integrator.periodic;
    while (true) {
        if (periodic.place == periodic.steps)
            begin_cycle_of(integrator, mesh_lanes(model.train), until);
        CycleStep& step = periodic.cycle_steps[periodic.place++];
        ++integrator.control.repeated;
        if (delay(periodic.start, until) <= step.end.after) return step;
        add_sums(step.sums, integrator.sums.total, mesh_lanes(model.train));
    }
}

void check_periodicity(const Model& model, Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    if (periodic.cycles == 0) return;
    if (periodic.recording) record_step(integrator);
    if (!begins_mesh_cycle(integrator)) return;
    if (++periodic.passed < periodic.cycles) return;
    periodic.passed = 0;
    check_repetition(model, integrator);
}

void restart_settling(Integrator& integrator) {
    Periodic& periodic = integrator.periodic;
    periodic.age = periodic.reference_age = periodic.passed = 0;
    periodic.recording = periodic.replaying = false;
}

void continue_from(const Model& model, Integrator& integrator, const CycleStep& step) {
    const Periodic& periodic = integrator.periodic;
    restore(periodic, step.begin, integrator.begin);
    restore(periodic, step.end, integrator.end);
    integrator.control.collocated = step.collocated;
    integrator.control.step = step.end.after - step.begin.after;
    std::memcpy(integrator.last.power, step.power, sizeof step.power);
    std::memcpy(integrator.last.friction_force, step.friction_force, sizeof step.friction_force);
    integrator.run.motion = step.motion;
    integrator.sums.step = step.sums;
    const State& begin = integrator.begin;
    set_step_constants(model, begin, integrator.constants);
    if (step.collocated) return;  // otherwise dense output computes the step again
    place_bristles(integrator.first.pairs, begin.bristle);
    forces(model, begin, integrator.constants, begin.x, begin.v, 0.0, begin.trim, integrator.first);
}

}  // namespace gearbox
