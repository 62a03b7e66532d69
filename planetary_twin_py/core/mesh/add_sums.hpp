#pragma once

// Integrals over an interval for each mesh: statistics of windows and runs, independent of samples.

#include "capacities.hpp"
#include "mesh/mesh_sums.hpp"
#include "vector/attributes.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Extend the damage and the extremes of `total`.
NOINLINE inline void add_damage(const MeshSums& step, MeshSums& total, std::int64_t lanes) {
    using V = Row<FEW_LANES>;
    total.damaging = true;
    for (std::int64_t i = 0; i < lanes; i += FEW_LANES) {
        for (int row = 0; row < DAMAGES; ++row)
            (V(total.damage[row] + i) + V(step.damage[row] + i)).store(total.damage[row] + i);
        for (int row = 0; row < EXTREMES; ++row)
            larger(V(total.extreme[row] + i), V(step.extreme[row] + i))
                .store(total.extreme[row] + i);
    }
    total.passed.insert(total.passed.end(), step.passed.begin(), step.passed.end());
}

// Extend `total` by `step`; `lanes` is that of the meshes, in whole rows. Of all rows at once, gcc
// would keep most on the stack.
inline void add_sums(const MeshSums& step, MeshSums& total, std::int64_t lanes) {
    if (total.time == 0.0) {
        total = step;
        return;
    }
    total.time += step.time;
    if (step.damaging) add_damage(step, total, lanes);
    using V = Row<FEW_LANES>;
    for (std::int64_t i = 0; i < lanes; i += FEW_LANES) {
#pragma GCC unroll 4
        for (int row = 0; row < SUMS; ++row)
            (V(total.integral[row] + i) + V(step.integral[row] + i)).store(total.integral[row] + i);
        larger(V(total.dte_peak + i), V(step.dte_peak + i)).store(total.dte_peak + i);
        larger(V(total.force_peak + i), V(step.force_peak + i)).store(total.force_peak + i);
    }
}

}  // namespace gearbox
