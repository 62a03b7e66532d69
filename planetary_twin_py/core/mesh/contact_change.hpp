#pragma once

// Changes of state when flanks come into contact or separate, and when tooth pairs enter or leave a
// mesh.

#include "mesh/deflection.hpp"
#include "mesh/slope.hpp"
#include "mesh/stiffness.hpp"
#include "train/model.hpp"
#include "train/set_step_constants.hpp"
#include "tribology/bristles.hpp"

namespace gearbox {

// Elastic energy [J] of mesh i and its copies after `cycles` of the train; `step` is work space for
// the position of the mesh.
inline double energy_at(const Model& model, const State& state, StepConstants& step, std::int64_t i,
                        double cycles) {
    if (state.side[i] == OPEN) return 0.0;
    const Train& train = model.train;
    double side = static_cast<double>(state.side[i]);
    std::int64_t kind = train.kind[i], segment = state.segment[i];
    place_mesh(train, state, step, i, cycles);
    double u = step.start[i] - step.low[i];
    double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
    double energy = 0.0, stiffness = 0.0;
    for (std::int64_t p = 0; p < train.present[kind][segment]; ++p) {
        auto [k, gap] = pair_stiffness(train, step, i, segment, p, u);
        double q = side * d - model.load.offset - gap;
        if (gap > 0.0 && q <= 0.0) continue;
        energy += 0.5 * k * (q * q - model.load.inner_squared);
        stiffness += k;
    }
    if (tilts(train)) energy += slope_energy(train, i, stiffness, state.x);
    return train.copies[i] * energy;
}

// The same at the cycles of the state.
inline double stored_energy(const Model& model, const State& state, StepConstants& step,
                            std::int64_t i) {
    const Train& train = model.train;
    double cycles = frame_cycle(train, state, 1) + cycle_shift(train, state.x);
    return energy_at(model, state, step, i, cycles);
}

// Close an open mesh on the side where contact starts, or open a closed one.
//
// Flanks separate at d > b and come into contact again without compression. The elastic energy that
// is stored when they separate is lost in the material. `step` is work space for the position of
// the mesh.
inline void change_contact(const Model& model, State& state, StepConstants& step, std::int64_t i) {
    const Train& train = model.train;
    double before = stored_energy(model, state, step, i);
    if (state.side[i] == OPEN) {
        place_mesh(train, state, step, i,
                   frame_cycle(train, state, 1) + cycle_shift(train, state.x));
        double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
        std::int64_t side = d > 0.0 ? DRIVE_SIDE : COAST_SIDE;
        if constexpr (MOVING) side = only_side(train, i);
        state.segment[i] =
            find_segment(train, train.kind[i], mesh_cycle(train, state, i, side), 1.0);
        state.side[i] = side;
    } else {
        state.side[i] = OPEN;
    }
    clear_bristles(train, state.bristle, i);
    state.energy[DAMPING] += before - stored_energy(model, state, step, i);
}

// Whether the stiffness of mesh i without faults jumps from a segment to the next.
inline bool stiffness_jumps(const Train& train, std::int64_t i, std::int64_t segment,
                            std::int64_t after, bool forwards) {
    constexpr double ROUNDING = 1e-12;
    const double* edge = train.edge[train.kind[i]];
    double before = mesh_stiffness(train, i, segment, edge[forwards ? segment + 1 : segment]);
    double then = mesh_stiffness(train, i, after, edge[forwards ? after : after + 1]);
    return std::abs(then - before) > ROUNDING * before;
}

// Move mesh i to the next segment; a jump of the stiffness does work on the train.
inline void change_segment(const Model& model, State& state, StepConstants& step, std::int64_t i,
                           std::int64_t direction) {
    const Train& train = model.train;
    const std::int64_t kind = train.kind[i], segment = state.segment[i];
    const std::int64_t count = train.segments[kind], after = (segment + direction + count) % count;
    if (train.faults == 0 && !stiffness_jumps(train, i, segment, after, direction > 0)) {
        state.segment[i] = after;
        return;
    }
    double cycles = frame_cycle(train, state, 1) + cycle_shift(train, state.x);
    double before = energy_at(model, state, step, i, cycles);
    state.segment[i] = after;
    state.energy[STIFFNESS_WORK] += energy_at(model, state, step, i, cycles) - before;
}

}  // namespace gearbox
