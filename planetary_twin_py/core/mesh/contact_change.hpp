#pragma once

// Changes of state when flanks come into contact or separate, and when tooth pairs enter or leave a
// mesh.

#include "lubrication/bristles.hpp"
#include "mesh/deflection.hpp"
#include "mesh/slope.hpp"
#include "mesh/stiffness.hpp"
#include "model/model.hpp"
#include "model/set_step_constants.hpp"

namespace gearbox {

// Elastic energy [J] of mesh i and its copies; `step` is work space for the position of the mesh.
NOINLINE inline double stored_energy(const Model& model, const State& state, StepConstants& step,
                                     std::int64_t i) {
    if (state.side[i] == OPEN) return 0.0;
    const Train& train = model.train;
    double side = static_cast<double>(state.side[i]);
    std::int64_t kind = train.mesh.kind[i], segment = state.segment[i];
    place_mesh(train, state, step, i, frame_cycle(train, state, 1) + cycle_shift(train, state.x));
    double u = step.start[i] - step.low[i];
    double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
    double energy = 0.0, stiffness = 0.0;
    for (std::int64_t p = 0; p < train.teeth.present[kind][segment]; ++p) {
        auto [k, gap] = pair_stiffness(train, step, i, segment, p, u);
        double q = side * d - model.operation.backlash.offset - gap;
        if (gap > 0.0 && q <= 0.0) continue;
        energy += 0.5 * k * (q * q - model.operation.backlash.inner_squared);
        stiffness += k;
    }
    if (tilts(train)) energy += slope_energy(train, i, stiffness, state.x);
    return train.mesh.copies[i] * energy;
}

// Close an open mesh on the side where contact starts, or open a closed one.
//
// Flanks separate at d > b and come into contact again without compression. The elastic energy that
// is stored when they separate is lost in the material. `step` is work space for the position of
// the mesh.
NOINLINE inline void change_contact(const Model& model, State& state, StepConstants& step,
                                    std::int64_t i) {
    const Train& train = model.train;
    double before = stored_energy(model, state, step, i);
    if (state.side[i] == OPEN) {
        place_mesh(train, state, step, i,
                   frame_cycle(train, state, 1) + cycle_shift(train, state.x));
        double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
        std::int64_t side = d > 0.0 ? DRIVE_SIDE : COAST_SIDE;
        if constexpr (MOVING) side = only_side(train, i);
        state.segment[i] =
            find_segment(train, train.mesh.kind[i], mesh_cycle(train, state, i, side), 1.0);
        state.side[i] = side;
    } else {
        state.side[i] = OPEN;
    }
    clear_bristles(train, state.bristle, i);
    state.energy[DAMPING] += before - stored_energy(model, state, step, i);
}

// Deflection q of closed mesh i on its side; `step` is work space for its errors of form.
inline double squeeze(const Model& model, const State& state, StepConstants& step, std::int64_t i) {
    const Train& train = model.train;
    const double side = static_cast<double>(state.side[i]);
    double d = mesh_motion(train, i, state.x);
    if (train.errors.lines[train.mesh.kind[i]] > 0) {
        place_lines(train, state, i, step.line_angle);
        d -= form_error(train, i, side, step.line_angle, 0.0, 0.0).length;
    }
    return side * d - model.operation.backlash.offset;
}

// Work on the train as closed mesh i without faults, and its copies, become stiffer by `stiffer`
// [N/m] at once.
inline double work_of_jump(const Model& model, const State& state, StepConstants& step,
                           std::int64_t i, double stiffer) {
    const double q = squeeze(model, state, step, i);
    double work = 0.5 * stiffer * (q * q - model.operation.backlash.inner_squared);
    if (tilts(model.train)) work += slope_energy(model.train, i, stiffer, state.x);
    return model.train.mesh.copies[i] * work;
}

// The same for a mesh with faults, which enters segment `after`.
COLD inline double work_of_faulty_jump(const Model& model, State& state, StepConstants& step,
                                       std::int64_t i, std::int64_t after) {
    const std::int64_t segment = state.segment[i];
    const double before = stored_energy(model, state, step, i);
    state.segment[i] = after;
    const double work = stored_energy(model, state, step, i) - before;
    state.segment[i] = segment;
    return work;
}

// Stiffness [N/m] of mesh i without faults at a position in its cycle, by the law of a segment.
inline double stiffness_by(const Train& train, std::int64_t i, std::int64_t segment, double cycle) {
    return mesh_stiffness(train, i, segment,
                          nearest_to_segment(train, train.mesh.kind[i], segment, cycle));
}

// Move mesh i, at this position in its cycle, to the next segment in this direction; a jump of its
// stiffness does work on the train. `step` is work space for the position of the mesh.
inline void change_segment(const Model& model, State& state, StepConstants& step, std::int64_t i,
                           std::int64_t direction, double cycle) {
    const Train& train = model.train;
    const std::int64_t segment = state.segment[i],
                       last = train.teeth.segments[train.mesh.kind[i]] - 1;
    const std::int64_t after =
        direction > 0 ? (segment < last ? segment + 1 : 0) : (segment > 0 ? segment - 1 : last);
    if (train.faults.count > 0) {
        state.energy[STIFFNESS_WORK] += work_of_faulty_jump(model, state, step, i, after);
    } else if (state.side[i] != OPEN) {
        const double stiffer =
            stiffness_by(train, i, after, cycle) - stiffness_by(train, i, segment, cycle);
        state.energy[STIFFNESS_WORK] += work_of_jump(model, state, step, i, stiffer);
    }
    state.segment[i] = after;
}

}  // namespace gearbox
