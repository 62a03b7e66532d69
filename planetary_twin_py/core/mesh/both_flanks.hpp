#pragma once

// Detects meshes in which both flanks of a tooth touch, of which this model loads one.
//
// Radial errors e_R that close more than half the backlash b press the other flank into its
// neighbour as well, unless the load squeezes the flank that carries by more than 2 (|e_R| - b).

#include "mesh/deflection.hpp"
#include "mesh/form_errors.hpp"
#include "model/model.hpp"

namespace gearbox {

// Whether both flanks of some mesh touch at a state, with the constants of a step from there.
inline bool both_flanks_touch(const Model& model, const State& state, const StepConstants& step) {
    if constexpr (MOVING) return false;  // each flank has its own force
    const Train& train = model.train;
    const bool turned_only = train.errors.lines[0] == train.errors.harmonics[0] &&
                             train.errors.lines[1] == train.errors.harmonics[1];
    if (turned_only) return false;  // the errors have no radial part
    const double half = model.operation.backlash.half;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        std::int64_t kind = train.mesh.kind[i];
        if (state.side[i] == OPEN || train.errors.lines[kind] == train.errors.harmonics[kind])
            continue;
        double gap = half + radial_error(train, i, step.line_angle, 0.0, 0.0).length;
        if (gap >= 0.0) continue;
        double d = deflection(train, step, i, state.x, state.v, 0.0, 0.0).d;
        if (static_cast<double>(state.side[i]) * d - half < -2.0 * gap) return true;
    }
    return false;
}

}  // namespace gearbox
