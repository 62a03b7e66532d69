#pragma once

// What happens when flanks meet or part, and when tooth pairs enter or leave a mesh.

#include "mesh/deflection.hpp"
#include "mesh/stiffness.hpp"
#include "train/model.hpp"
#include "train/set_step_constants.hpp"
#include "tribology/bristles.hpp"

namespace gearbox {

// Elastic energy [J] of mesh i and its copies; `step` is room for where it stands.
inline double stored_energy(const Model& model, const State& state, StepConstants& step,
                            std::int64_t i) {
    if (state.side[i] == OPEN) return 0.0;
    const Train& train = model.train;
    double side = static_cast<double>(state.side[i]);
    std::int64_t kind = train.kind[i], segment = state.segment[i];
    place_mesh(train, state, step, i, frame_cycle(train, state, 1) + cycle_shift(train, state.x));
    double u = step.start[i] - step.low[i];
    double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
    double energy = 0.0;
    for (std::int64_t p = 0; p < train.present[kind][segment]; ++p) {
        auto [k, gap] = pair_stiffness(train, step, i, segment, p, u);
        double q = side * d - model.load.offset - gap;
        if (gap == 0.0 || q > 0.0) energy += 0.5 * k * (q * q - model.load.inner_squared);
    }
    return train.copies[i] * energy;
}

// Close an open mesh on the side it has reached, or open a closed one.
//
// What the flanks still store at the moment they part is lost in the material: flanks part at
// d > b, and later meet again at no compression. `step` is room for where the mesh stands.
inline void change_contact(const Model& model, State& state, StepConstants& step, std::int64_t i) {
    const Train& train = model.train;
    double before = stored_energy(model, state, step, i);
    if (state.side[i] == OPEN) {
        place_mesh(train, state, step, i,
                   frame_cycle(train, state, 1) + cycle_shift(train, state.x));
        double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
        std::int64_t side = d > 0.0 ? DRIVE_SIDE : COAST_SIDE;
        state.segment[i] =
            find_segment(train, train.kind[i], mesh_cycle(train, state, i, side), 1.0);
        state.side[i] = side;
    } else {
        state.side[i] = OPEN;
    }
    clear_bristles(train, state.bristle, i);
    state.energy[DAMPING] += before - stored_energy(model, state, step, i);
}

// Move mesh i to the next segment; a jump of the stiffness does work on the train.
inline void change_segment(const Model& model, State& state, StepConstants& step, std::int64_t i,
                           std::int64_t direction) {
    std::int64_t count = model.train.segments[model.train.kind[i]];
    double before = stored_energy(model, state, step, i);
    pass_bristles(model.train, state.bristle, i, state.segment[i], direction);
    state.segment[i] = (state.segment[i] + direction + count) % count;
    state.energy[STIFFNESS_WORK] += stored_energy(model, state, step, i) - before;
}

}  // namespace gearbox
