#pragma once

// Faulty teeth, and the pairs of each mesh that contain them.
//
// Pairs are numbered as they pass the pitch point. On the drive side pair n of a mesh is tooth n of
// both gears (counted modulo their teeth, backwards on the mate); on the coast side, where the
// motion is mirrored and half a pitch late, it is tooth -n of the first gear and tooth 1 - n of the
// second.

#include <cmath>

#include "mesh/cycle.hpp"
#include "model/step_constants.hpp"

namespace gearbox {

constexpr std::int64_t NOWHERE = -1;

// Add fault f to the pairs of mesh i after `whole` cycles, modulo the teeth of its gear.
inline void mark_fault(const Train& train, std::int64_t i, std::int64_t side, std::int64_t segment,
                       std::int64_t f, std::int64_t whole, StepConstants& step) {
    const Faults& faults = train.faults;
    const std::int64_t kind = train.mesh.kind[i], pair = faults.pair[f][i][side != DRIVE_SIDE];
    if (pair == NOWHERE) return;
    for (int p = 0; p < PAIRS; ++p) {
        auto behind = static_cast<std::int64_t>(std::floor(train.teeth.shift[kind][segment][p]));
        std::int64_t tooth = (whole - behind - pair) % faults.teeth[f];
        if (tooth != 0 && !faults.each[f]) continue;
        if (tooth < 0) tooth += faults.teeth[f];
        step.gap[i][p] += faults.gap[faults.first_gap[f] + tooth];
        if (faults.first_factor[f][kind] != NOWHERE) step.faulty[i][p] |= std::uint64_t{1} << f;
    }
}

// Begin with pairs of mesh i that have no faults.
inline void clear_faults(StepConstants& step, std::int64_t i) {
    for (int p = 0; p < PAIRS; ++p) {
        step.faulty[i][p] = 0;
        step.gap[i][p] = 0.0;
    }
}

// Find the faults of the pairs of mesh i, at `start` in its cycle.
inline void find_faults(const Train& train, const State& state, std::int64_t i, std::int64_t side,
                        double start, StepConstants& step) {
    clear_faults(step, i);
    for (std::int64_t f = 0; f < train.faults.count; ++f) {
        double cycle = counted_cycle(train, state, i, side, train.faults.teeth[f]);
        auto whole = static_cast<std::int64_t>(std::nearbyint(cycle - start));
        mark_fault(train, i, side, state.segment[i], f, whole, step);
    }
}

}  // namespace gearbox
