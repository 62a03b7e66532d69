#pragma once

// Notices meshes in which both flanks of a tooth touch, of which this model carries one.
//
// Runout of which the radial part e_R exceeds half the backlash b presses the other flank into its
// neighbour as well, unless the load squeezes the flank that carries by more than 2 (|e_R| - b).

#include "integrators/march_record.hpp"
#include "mesh/deflection.hpp"
#include "mesh/form_errors.hpp"
#include "train/model.hpp"

namespace gearbox {

// Count the step that begins where both flanks of a mesh touch.
inline void note_both_flanks(const Model& model, March& march) {
    const Train& train = model.train;
    const State& begin = march.begin;
    const double half = model.load.half_backlash;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        std::int64_t kind = train.kind[i];
        if (begin.side[i] == OPEN || train.lines[kind] == train.harmonics[kind]) continue;
        double gap = half + radial_error(train, i, march.constants.line_angle, 0.0, 0.0).length;
        if (gap >= 0.0) continue;
        double d = deflection(train, march.constants, i, begin.x, begin.v, 0.0, 0.0).d;
        if (static_cast<double>(begin.side[i]) * d - half < -2.0 * gap) {
            ++march.control.both_flanks;
            return;
        }
    }
}

}  // namespace gearbox
