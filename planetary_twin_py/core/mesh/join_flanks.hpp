#pragma once

// Results of both flanks of a mesh together, where each has an entry among the meshes.

#include "capacities.hpp"
#include "mesh/mesh_sums.hpp"
#include "model/train.hpp"
#include "vector/math.hpp"

namespace gearbox {

// The entry of the other flanks of the mesh that has entry i.
inline std::int64_t other_flank(const Train& train, std::int64_t i) {
    return (i + train.meshes / 2) % train.meshes;
}

// Give both entries of every mesh the forces, films and losses of both flanks. Transmission
// errors stay those of each flank.
inline void join_flanks(const Train& train, MeshSums& sums) {
    for (std::int64_t i = 0; i < train.meshes / 2; ++i) {
        const std::int64_t other = other_flank(train, i);
        for (int row = 0; row < SUMS; ++row) {
            if (row == DTE || row == SQUARE) continue;
            double* integral = sums.integral[row];
            integral[i] = integral[other] = integral[i] + integral[other];
        }
        for (int row = 0; row < BEARING_DAMAGE; ++row) {
            double* damage = sums.damage[row];
            damage[i] = damage[other] = damage[i] + damage[other];
        }
        for (auto& row : sums.extreme) row[i] = row[other] = at_least(row[i], row[other]);
        double peak = at_least(sums.force_peak[i], sums.force_peak[other]);
        sums.force_peak[i] = sums.force_peak[other] = peak;
    }
}

}  // namespace gearbox
