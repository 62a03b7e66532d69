#pragma once

// The parabola through values at three times.

#include "vector/rows.hpp"

namespace gearbox {

// Three times, in any unit.
struct Neighbours {
    double before, after;  // inverse distances of the outer ones from the middle, the first below 0
    double share;          // of the first interval in both
    double quarter;        // of both intervals
};

inline constexpr Neighbours EVEN{-1.0, 1.0, 0.5, 0.5};

// From the distances of the outer times from the middle one.
constexpr Neighbours neighbours_at(double left, double right) {
    const double span = right - left;
    return {1.0 / left, 1.0 / right, -left / span, 0.25 * span};
}

// Vertex of the parabola, if it lies between the outer times; else the middle value.
template <int L>
ALWAYS_INLINE Row<L> vertex(const Neighbours& at, const Row<L>& before, const Row<L>& middle,
                            const Row<L>& after) {
    using V = Row<L>;
    V a = (before - middle) * at.before, b = (after - middle) * at.after, bend = b - a;
    V slope = fused(bend, at.share, a), ratio = slope / bend;
    Mask<L> between = (ratio > 2.0 * at.share - 2.0) & (ratio < 2.0 * at.share);
    return select(between, fused(slope * ratio, -at.quarter, middle), middle);
}

}  // namespace gearbox
