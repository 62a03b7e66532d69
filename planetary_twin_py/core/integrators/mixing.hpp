#pragma once

// Acceleration of the sweeps where friction damps moving axes.
//
// Where sliding reverses, friction damps the displacements of the axes so strongly that sweeps
// diverge, though in few directions. The remainder is mixed from two sweeps so that the error of a
// problem that is linear along one direction vanishes (Anderson 1965, J. ACM 12, 547-560, depth
// one).

#include <cmath>

#include "integrators/propagation.hpp"

namespace gearbox {

// Largest contraction of the error by a sweep without mixing. Forces at the nodes, from which the
// energy ledger is computed, belong to a remainder that is not mixed.
inline constexpr double POOR = 0.3;

template <int L>
class Mixing {
public:
    // Store the remainder from which the motion of the nodes was computed.
    void keep(const Propagation& run) {
        for (std::int64_t n = 0; n < run.nodes.count; ++n) copy<L>(run.remainder[n], used[n]);
    }

    // Mix the remainder of the last sweep with the one before.
    void mix(Propagation& run) {
        using V = Row<L>;
        // Displacement of a mode by the remainder over a step.
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

    // Contraction of the error by a sweep without mixing; 0: not known.
    double contraction() const { return ratio; }

private:
    alignas(64) double used[MOST_NODES][BODIES];
    alignas(64) double used_before[MOST_NODES][BODIES];
    alignas(64) double left_before[MOST_NODES][BODIES];
    double size_before = 0.0, ratio = 0.0;
    int swept = 0;
};

}  // namespace gearbox
