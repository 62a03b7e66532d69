#pragma once

// Position of each mesh in its cycle: which teeth are in contact, and where on their path.
//
// A mesh cycle is the passage of one tooth. The rigid frame gives whole turns as integers, so
// cycles stay exact however long the gearbox turns; whole cycles are counted modulo the teeth of a
// gear.

#include <cmath>

#include "capacities.hpp"
#include "model/state.hpp"
#include "model/train.hpp"
#include "vector/lanes.hpp"

namespace gearbox {

// Mesh cycles by which the train is ahead of the rigid frame.
inline double cycle_shift(const Train& train, const double* x) {
    return train.cycle.sun_advance * x[train.sun] + train.cycle.carrier_advance * x[train.carrier];
}

// Mesh cycles of the rigid frame since the start, modulo `modulus`.
inline double frame_cycle(const Train& train, const State& state, std::int64_t modulus) {
    double total = 0.0;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        std::int64_t denominator = train.cycle.denominator[a];
        std::int64_t period = denominator * modulus;
        std::int64_t turns = static_cast<std::int64_t>(state.turns[a]);
        std::int64_t whole = turns * train.cycle.numerator[a] % period;
        if (whole < 0) whole += period;
        total += static_cast<double>(whole) / static_cast<double>(denominator) +
                 train.cycle.per_turn[a] * state.fraction[a];
    }
    double m = static_cast<double>(modulus);
    return total - m * std::floor(total / m);
}

// Cycles since tooth pair 0 of mesh i was at the pitch point, from the mesh `cycle` that the train
// has reached since the start: modulo `modulus`, from the first edge of the segments on. On the
// coast flanks the motion is mirrored, and later by `coast_lead`, half a pitch for teeth as thick
// as their spaces.
inline double cycle_on_side(const Train& train, std::int64_t i, std::int64_t side, double cycle,
                            std::int64_t modulus) {
    cycle = static_cast<double>(side) * (cycle - train.mesh.phase[i]);
    if (side == COAST_SIDE) cycle += train.geometry.coast_lead[train.mesh.kind[i]];
    double m = static_cast<double>(modulus);
    return cycle - m * std::floor((cycle - train.teeth.edge[train.mesh.kind[i]][0]) / m);
}

// The side on which an entry of the meshes may be closed: both (OPEN) where it stands for all of
// its mesh, one where each flank has an entry.
inline std::int64_t only_side(const Train& train, std::int64_t i) {
    if constexpr (!MOVING) return OPEN;
    return i < train.meshes / FLANKS ? DRIVE_SIDE : COAST_SIDE;
}

// Number of planets that are integrated.
inline std::int64_t planets_of(const Train& train) {
    return train.meshes / (KINDS * FLANKS);
}

// The same at a state.
inline double counted_cycle(const Train& train, const State& state, std::int64_t i,
                            std::int64_t side, std::int64_t modulus) {
    double cycle = frame_cycle(train, state, modulus) + cycle_shift(train, state.x);
    return cycle_on_side(train, i, side, cycle, modulus);
}

// Position of mesh i in its cycle on one side, between the first and the last edge of its segments.
inline double mesh_cycle(const Train& train, const State& state, std::int64_t i,
                         std::int64_t side) {
    return counted_cycle(train, state, i, side, 1);
}

// Segment of the table of tooth pairs at a position in the cycle; at an edge, the one ahead.
inline std::int64_t find_segment(const Train& train, std::int64_t kind, double cycle,
                                 double direction) {
    std::int64_t last = train.teeth.segments[kind] - 1, segment = 0;
    while (segment < last && train.teeth.edge[kind][segment + 1] <= cycle) ++segment;
    if (direction < 0.0 && cycle == train.teeth.edge[kind][segment])
        segment = segment > 0 ? segment - 1 : last;
    return segment;
}

// The representative of `cycle` modulo 1 that lies in or next to a segment between two edges.
template <class Real>
ALWAYS_INLINE Real nearest_between(const Real& low, const Real& high, const Real& cycle) {
    Real middle = 0.5 * (low + high);
    return cycle - whole_below(cycle - middle + 0.5);
}

inline double nearest_to_segment(const Train& train, std::int64_t kind, std::int64_t segment,
                                 double cycle) {
    const double* edge = train.teeth.edge[kind];
    return nearest_between(edge[segment], edge[segment + 1], cycle);
}

}  // namespace gearbox
