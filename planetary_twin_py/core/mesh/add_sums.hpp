#pragma once

// Integrals over an interval for each mesh: statistics of windows and runs, independent of samples.

#include "capacities.hpp"
#include "mesh/mesh_sums.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Extend `total` by `step`; `lanes` is that of the meshes.
inline void add_sums(const MeshSums& step, MeshSums& total, std::int64_t lanes) {
    if (total.time == 0.0) {
        total = step;
        return;
    }
    total.time += step.time;
    for (int row = 0; row < SUMS; ++row)
        for (std::int64_t i = 0; i < lanes; ++i) total.integral[row][i] += step.integral[row][i];
    for (std::int64_t i = 0; i < lanes; ++i) {
        total.dte_peak[i] = at_least(total.dte_peak[i], step.dte_peak[i]);
        total.force_peak[i] = at_least(total.force_peak[i], step.force_peak[i]);
    }
}

}  // namespace gearbox
