#pragma once

// Constants of one step: positions of the meshes at its start, and the parameters of their forces.

#include <cmath>
#include <numbers>

#include "mesh/cycle.hpp"
#include "mesh/damping.hpp"
#include "mesh/faults.hpp"
#include "mesh/form_errors.hpp"
#include "model/body_speed.hpp"
#include "model/model.hpp"
#include "model/step_constants.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Copy side and segment of mesh i from the tables; those of an open mesh have no stiffness.
NOINLINE inline void copy_segment(const Train& train, const State& state, StepConstants& step,
                                  std::int64_t i) {
    std::int64_t kind = train.mesh.kind[i], segment = state.segment[i], side = state.side[i];
    step.side[i] = static_cast<double>(side);
    step.segment[i] = segment + 1;
    step.base[i] = train.mesh.stiffness_factor[i] * train.teeth.stiffness_base[kind];
    step.gain[i] = train.mesh.stiffness_factor[i] * train.teeth.stiffness_gain[kind];
    step.fixed_damping_time[i] = train.damping.time[kind];
    step.external[i] = train.geometry.external[kind];
    step.lead[i] = side == COAST_SIDE ? train.geometry.coast_lead[kind] : 0.0;
    step.low[i] = train.teeth.edge[kind][segment];
    step.high[i] = train.teeth.edge[kind][segment + 1];
    for (std::int64_t t = 0; t < train.teeth.terms; ++t) {
        for (std::int64_t p = 0; p < train.teeth.slots; ++p)
            step.weight[p][t][i] = side != OPEN ? train.teeth.weight[kind][segment][p][t] : 0.0;
        step.weight[TOTAL][t][i] = train.teeth.weight[kind][segment][TOTAL][t];
    }
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        double centre = train.teeth.centre[kind][segment][p] * train.geometry.base_pitch;
        step.rho1[p][i] = train.geometry.pitch_curvature[kind][0] + centre;
        step.rho2[p][i] =
            train.geometry.pitch_curvature[kind][1] - train.geometry.external[kind] * centre;
        step.travel[p][i] = train.teeth.travel[kind][segment][p];
        step.face[p][i] = train.teeth.face[kind][segment][p];
        step.face_growth[p][i] = train.teeth.face_growth[kind][segment][p];
    }
}

// Fill the tables of mesh i in `step` for its side and segment.
inline void select_tables(const Train& train, const State& state, StepConstants& step,
                          std::int64_t i) {
    if (train.errors.lines[train.mesh.kind[i]] > 0) place_lines(train, state, i, step.line_angle);
    if (step.segment[i] != state.segment[i] + 1 ||
        step.side[i] != static_cast<double>(state.side[i]))
        copy_segment(train, state, step, i);
}

// Position of a closed mesh in its cycle, from the `cycles` of its drive side.
template <class Real>
ALWAYS_INLINE Real place_in_cycle(double cycles, const Real& phase, const Real& side,
                                  const Real& lead, const Real& low, const Real& high) {
    return nearest_between(low, high, side * (cycles - phase) + lead);
}

// Fill the entries of mesh i in `step`.
inline void place_mesh(const Train& train, const State& state, StepConstants& step, std::int64_t i,
                       double cycles) {
    select_tables(train, state, step, i);
    step.start[i] = step.low[i];
    if (state.side[i] == OPEN) return;
    step.start[i] = place_in_cycle(cycles, train.mesh.phase[i], step.side[i], step.lead[i],
                                   step.low[i], step.high[i]);
    if (train.faults.count > 0) find_faults(train, state, i, state.side[i], step.start[i], step);
}

// The same for all meshes.
template <int L>
void place_all_meshes(const Train& train, const State& state, StepConstants& step, double cycles) {
    using V = Row<L>;
    for (std::int64_t i = 0; i < train.meshes; ++i) select_tables(train, state, step, i);
    V side(step.side), low(step.low);
    V start = place_in_cycle(cycles, V(train.mesh.phase), side, V(step.lead), low, V(step.high));
    select(side == 0.0, low, start).store(step.start);
    for (std::int64_t i = 0; train.faults.count > 0 && i < train.meshes; ++i)
        if (state.side[i] != OPEN) find_faults(train, state, i, state.side[i], step.start[i], step);
}

// Mesh cycles per second of the rigid frame, signed.
inline double frame_cycle_rate(const Train& train, const State& state) {
    double rate = 0.0;
    for (int a = 0; a < AXES; ++a) rate += train.cycle.per_turn[a] * state.speed[a];
    return rate * (0.5 * std::numbers::inv_pi);
}

// Torques of the load at a state; given ones may change with time.
inline void place_torques(const Operation& operation, const State& state, StepConstants& step) {
    double passed = static_cast<double>(state.seconds - operation.since_seconds);
    passed += state.time - operation.since;
    for (int c = 0; c < MACHINES; ++c)
        step.torque[c] = operation.torque[c] + operation.torque_rate[c] * passed;
}

// Torques of the machines: of the load, and of the motors and the load that control their speeds.
inline void place_drives(const Model& model, const State& state, StepConstants& step) {
    const Train& train = model.train;
    const Operation& operation = model.operation;
    for (std::int64_t c = 0; c < train.machines; ++c) {
        const std::int64_t body = train.coupling.ends[c][0], own = c / 2;
        Drive& drive = step.drive[c];
        const bool controls = c != LOAD_MACHINE;
        const double ratio = controls ? 1.0 : train.body.ratio[0][body];
        drive.gain = controls ? operation.proportional[own] : operation.load_proportional;
        drive.torque = step.torque[c] + drive.gain * (ratio * state.set_speed[own] -
                                                      rigid_speed(train, state, body));
        drive.rate = operation.torque_rate[c] + drive.gain * ratio * step.slew[own];
        for (std::int64_t a = 0; controls && a < train.axes; ++a)
            drive.torque += operation.inertia[own][a] * step.slew[a];
    }
}

// Speeds with the frame, from their ratios to those of the motors.
template <int L, int N>
ALWAYS_INLINE void turn_with_motors(const State& state, const double (&ratio)[AXES][N],
                                    double* speed) {
    (Row<L>(ratio[0]) * state.speed[0] + Row<L>(ratio[1]) * state.speed[1]).store(speed);
}

// The same of the bodies, and of the gears relative to the carrier.
template <int L>
void place_frame(const Train& train, const State& state, StepConstants& step) {
    turn_with_motors<L>(state, train.body.ratio, step.rigid);
    if constexpr (MOVING) {  // the frame follows the bodies, perhaps beyond their lanes
        const std::int64_t frame = train.moving.frame;
        step.rigid[frame] = rigid_speed(train, state, frame);
    }
    for (int g = 0; g < GEARS - 1; ++g)
        turn_with_motors<MESH_LANES<L>>(state, train.mesh.spin_ratio[g], step.spin[g]);
}

// Damping times of the meshes, whose teeth pass at this rate [1/s].
template <int L>
void place_damping(const Train& train, double rate, StepConstants& step) {
    const double following = train.damping.cycles / at_least(rate, train.damping.lowest_frequency);
    for (int kind = 0; kind < KINDS; ++kind) step.tau[kind] = train.damping.time[kind] + following;
    (Row<L>(step.fixed_damping_time) + following).store(step.damping_time);
}

// Fill `step` for a step that begins at `state`.
inline void set_step_constants(const Model& model, const State& state, StepConstants& step) {
    const Train& train = model.train;
    step.cycle_rate = frame_cycle_rate(train, state);
    for (std::int64_t a = 0; a < train.axes; ++a) {
        double gap = model.operation.target_speed[a] - state.set_speed[a];
        step.slew[a] = gap != 0.0 ? std::copysign(model.operation.slew_rate, gap) : 0.0;
    }
    place_torques(model.operation, state, step);
    place_drives(model, state, step);
    with_lanes(train, [&](auto lanes) { place_frame<lanes>(train, state, step); });
    double cycles = frame_cycle(train, state, 1) + cycle_shift(train, state.x);
    double rate = passing_rate(train, step, state.v);
    with_mesh_lanes(train, [&](auto lanes) {
        place_all_meshes<lanes>(train, state, step, cycles);
        place_damping<lanes>(train, rate, step);
    });
}

// The same after the tooth pairs of every mesh in contact are set to those at its place in the
// cycle.
inline void find_tooth_pairs(const Model& model, State& state, StepConstants& step) {
    const Train& train = model.train;
    const double rate = frame_cycle_rate(train, state);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        const std::int64_t side = state.side[i];
        if (side == OPEN) continue;
        const double direction = std::copysign(1.0, static_cast<double>(side) * rate);
        const double cycle = mesh_cycle(train, state, i, side);
        state.segment[i] = find_segment(train, train.mesh.kind[i], cycle, direction);
    }
    set_step_constants(model, state, step);
}

}  // namespace gearbox
