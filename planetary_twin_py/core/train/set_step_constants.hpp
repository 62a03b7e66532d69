#pragma once

// Constants of one step: positions of the meshes at its start, and the parameters of their forces.

#include <cmath>
#include <numbers>

#include "mesh/cycle.hpp"
#include "mesh/damping.hpp"
#include "mesh/faults.hpp"
#include "mesh/form_errors.hpp"
#include "train/model.hpp"
#include "train/step_constants.hpp"

namespace gearbox {

// Copy side and segment of mesh i from the tables; those of an open mesh have no stiffness.
inline void copy_segment(const Train& train, const State& state, StepConstants& step,
                         std::int64_t i) {
    std::int64_t kind = train.kind[i], segment = state.segment[i], side = state.side[i];
    step.side[i] = static_cast<double>(side);
    step.segment[i] = segment + 1;
    step.base[i] = train.stiffness_factor[i] * train.stiffness_base[kind];
    step.gain[i] = train.stiffness_factor[i] * train.stiffness_gain[kind];
    step.fixed[i] = train.damping_time[kind];
    step.external[i] = train.external[kind];
    step.low[i] = train.edge[kind][segment];
    step.high[i] = train.edge[kind][segment + 1];
    for (std::int64_t t = 0; t < train.terms; ++t) {
        for (std::int64_t p = 0; p < train.slots; ++p)
            step.weight[p][t][i] = side != OPEN ? train.weight[kind][segment][p][t] : 0.0;
        step.weight[TOTAL][t][i] = train.weight[kind][segment][TOTAL][t];
    }
    for (std::int64_t p = 0; p < train.slots; ++p) {
        double centre = train.centre[kind][segment][p] * train.base_pitch;
        step.rho1[p][i] = train.pitch_curvature[kind][0] + centre;
        step.rho2[p][i] = train.pitch_curvature[kind][1] - train.external[kind] * centre;
        step.travel[p][i] = train.travel[kind][segment][p];
        step.face[p][i] = train.face[kind][segment][p];
        step.face_growth[p][i] = train.face_growth[kind][segment][p];
    }
}

// Fill the entries of mesh i in `step`, from the cycles of its drive side.
inline void place_mesh(const Train& train, const State& state, StepConstants& step, std::int64_t i,
                       double cycles) {
    std::int64_t side = state.side[i], kind = train.kind[i];
    if (train.lines[kind] > 0) place_lines(train, state, i, step.line_angle);
    if (step.segment[i] != state.segment[i] + 1 || step.side[i] != static_cast<double>(side))
        copy_segment(train, state, step, i);
    if (side == OPEN) {
        step.start[i] = step.low[i];
        return;
    }
    double cycle = static_cast<double>(side) * (cycles - train.phase[i]);
    if (side == COAST_SIDE) cycle += train.coast_lead[kind];
    step.start[i] = nearest_to_segment(train, kind, state.segment[i], cycle);
    if (train.faults > 0) find_faults(train, state, i, side, step.start[i], step.faulty);
}

// Mesh cycles per second of the rigid frame, signed.
inline double frame_cycle_rate(const Train& train, const State& state) {
    double rate = 0.0;
    for (int a = 0; a < AXES; ++a) rate += train.cycles[a] * state.speed[a];
    return rate / (2.0 * std::numbers::pi);
}

// Torques of the load at a state; given ones may change with time.
inline void place_torques(const Load& load, const State& state, StepConstants& step) {
    double passed = static_cast<double>(state.seconds - load.since_seconds);
    passed += state.time - load.since;
    for (int c = 0; c < MACHINES; ++c)
        step.torque[c] = load.torque[c] + load.torque_rate[c] * passed;
}

// Fill `step` for a step that begins at `state`.
inline void set_step_constants(const Model& model, const State& state, StepConstants& step) {
    const Train& train = model.train;
    step.cycle_rate = frame_cycle_rate(train, state);
    for (std::int64_t a = 0; a < train.axes; ++a) {
        double gap = model.load.target_speed[a] - state.set_speed[a];
        step.slew[a] = gap != 0.0 ? std::copysign(model.load.slew_rate, gap) : 0.0;
    }
    place_torques(model.load, state, step);
    for (int j = 0; j < BODIES; ++j)
        step.rigid[j] = train.ratio[j][0] * state.speed[0] + train.ratio[j][1] * state.speed[1];
    for (std::int64_t i = 0; i < train.meshes; ++i)
        for (int g = 0; g < GEARS - 1; ++g)
            step.spin[g][i] = step.rigid[train.body[i][g]] - step.rigid[train.body[i][2]];
    double rate = passing_rate(train, step, state.v);
    for (int kind = 0; kind < KINDS; ++kind) step.tau[kind] = damping_time(train, kind, rate);
    for (std::int64_t i = 0; i < train.meshes; ++i) step.damping[i] = step.tau[train.kind[i]];
    double cycles = frame_cycle(train, state, 1) + cycle_shift(train, state.x);
    for (std::int64_t i = 0; i < train.meshes; ++i) place_mesh(train, state, step, i, cycles);
}

}  // namespace gearbox
