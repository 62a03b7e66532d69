#pragma once

// Faulty teeth, and the pairs of each mesh that contain them.
//
// Pairs are numbered as they pass the pitch point. On the drive side pair n of a mesh is tooth n of
// both gears (counted modulo their teeth, backwards on the mate); on the coast side, where the
// motion is mirrored and half a pitch late, it is tooth -n of the first gear and tooth 1 - n of the
// second.

#include <cmath>

#include "mesh/cycle.hpp"

namespace gearbox {

constexpr std::int64_t NOWHERE = -1;

// Fill faulty[i][p][f] after `whole` cycles, modulo the teeth of the gear of fault f.
inline void mark_fault(const Train& train, std::int64_t i, std::int64_t side, std::int64_t segment,
                       std::int64_t f, std::int64_t whole, std::int8_t (*faulty)[PAIRS][FAULTS]) {
    std::int64_t kind = train.mesh.kind[i], flank = side == DRIVE_SIDE ? 0 : 1;
    std::int64_t pair = train.faults.pair[f][i][flank], teeth = train.faults.teeth[f];
    for (int p = 0; p < PAIRS; ++p) {
        auto behind = static_cast<std::int64_t>(std::floor(train.teeth.shift[kind][segment][p]));
        std::int64_t number = whole - behind;
        faulty[i][p][f] = pair != NOWHERE && (number - pair) % teeth == 0;
    }
}

// Fill faulty[i][p][f]: whether pair p of mesh i, at `start` in its cycle, has fault f.
inline void find_faults(const Train& train, const State& state, std::int64_t i, std::int64_t side,
                        double start, std::int8_t (*faulty)[PAIRS][FAULTS]) {
    for (std::int64_t f = 0; f < train.faults.count; ++f) {
        double cycle = counted_cycle(train, state, i, side, train.faults.teeth[f]);
        auto whole = static_cast<std::int64_t>(std::nearbyint(cycle - start));
        mark_fault(train, i, side, state.segment[i], f, whole, faulty);
    }
}

}  // namespace gearbox
