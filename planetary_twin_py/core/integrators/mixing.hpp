#pragma once

// Sweeps that come to rest where friction damps axes that move.
//
// Within the layer in which sliding reverses, friction is a strong damper on the displacements of
// the axes: what a sweep computes overshoots by more than what was missing, though in few
// directions. The rest is mixed from two sweeps so that, were all linear in one direction, nothing
// would be left (Anderson 1965, J. ACM 12, 547-560, of depth one).

#include <cmath>

#include "integrators/propagation.hpp"

namespace gearbox {

// Share of what was missing that a sweep may leave without mixing. Forces at the nodes, of which
// the energy ledger is made, belong to a rest that is not mixed.
inline constexpr double POOR = 0.3;

template <int L>
class Mixing {
public:
    // Note the rest that the nodes have moved under.
    void keep(const Propagation& run) {
        for (std::int64_t n = 0; n < run.nodes.count; ++n) copy<L>(run.remainder[n], used[n]);
    }

    // Mix the rest of the last sweep with what it was before.
    void mix(Propagation& run) {
        using V = Row<L>;
        // What a mode moves by under the rest of a step.
        const double step = run.motion.step;
        V weight = 1.0 / larger(V(run.motion.square), V(1.0 / (step * step)));
        V across(0.0), along(0.0), size(0.0);
        for (std::int64_t n = 0; n < run.nodes.count; ++n) {
            V left = V(run.remainder[n]) - V(used[n]), own = left * weight;
            size += own * own;
            if (swept == 0) continue;
            V change = (left - V(left_before[n])) * weight;
            across += own * change;
            along += change * change;
        }
        const double now = std::sqrt(total(size));
        if (swept == 1 && size_before > 0.0) ratio = now / size_before;
        const bool slow = swept > 0 && now > POOR * size_before;
        const double length = total(along), share = length > 0.0 ? total(across) / length : 0.0;
        for (std::int64_t n = 0; n < run.nodes.count; ++n) {
            V remainder(run.remainder[n]), left = remainder - V(used[n]);
            if (slow) {
                V change = (left - V(left_before[n])) + (V(used[n]) - V(used_before[n]));
                (remainder - share * change).store(run.remainder[n]);
            }
            left.store(left_before[n]);
            copy<L>(used[n], used_before[n]);
        }
        size_before = now;
        ++swept;
    }

    // By how much a sweep without mixing would bring the next closer; 0: not known.
    double contraction() const { return ratio; }

private:
    alignas(64) double used[MOST_NODES][BODIES];
    alignas(64) double used_before[MOST_NODES][BODIES];
    alignas(64) double left_before[MOST_NODES][BODIES];
    double size_before = 0.0, ratio = 0.0;
    int swept = 0;
};

}  // namespace gearbox
