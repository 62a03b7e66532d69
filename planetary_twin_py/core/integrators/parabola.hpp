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

// Change of the slope of the parabola between the outer times, and its slope at the middle one.
template <int L>
struct Bend {
    Row<L> change, slope;
};

template <int L>
ALWAYS_INLINE Bend<L> bend_of(const Neighbours& at, const Row<L>& before, const Row<L>& middle,
                              const Row<L>& after) {
    const Row<L> a = (before - middle) * at.before, b = (after - middle) * at.after, change = b - a;
    return {change, fused(change, at.share, a)};
}

// Vertex of the parabola, if it lies between the outer times; else the middle value.
template <int L>
ALWAYS_INLINE Row<L> vertex(const Neighbours& at, const Row<L>& before, const Row<L>& middle,
                            const Row<L>& after) {
    const auto [bend, slope] = bend_of(at, before, middle, after);
    const Row<L> ratio = slope / bend;
    Mask<L> between = (ratio > 2.0 * at.share - 2.0) & (ratio < 2.0 * at.share);
    return select(between, fused(slope * ratio, -at.quarter, middle), middle);
}

// Where the middle value, with `times` its distance to the vertex, exceeds a magnitude: a test
// without the division that the vertex needs.
template <int L>
ALWAYS_INLINE Mask<L> exceeds(const Neighbours& at, const Row<L>& before, const Row<L>& middle,
                              const Row<L>& after, double times, const Row<L>& magnitude) {
    const auto [bend, slope] = bend_of(at, before, middle, after);
    const Row<L> room = magnitude - absolute(middle);
    return (room < 0.0) | (times * at.quarter * slope * slope > absolute(bend) * room);
}

}  // namespace gearbox
