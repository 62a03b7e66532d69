#pragma once

#include <cstdint>

#include "mesh/mesh_sums.hpp"

namespace gearbox {

// Transmission errors and forces at several times of a step.
struct alignas(64) Series {
    std::int64_t count;
    alignas(64) double at[129];                    // [s] since its start
    alignas(64) double weight[129];                // of a quadrature [s]
    alignas(64) double d[129][MESHES];             // [m]
    alignas(64) double normal_force[129][MESHES];  // [N]
};

struct alignas(64) StepSums {
    MeshSums step;   // of the last step
    MeshSums part;   // of a part of it
    MeshSums total;  // since the last reading, up to the start of the last step
    double taken;    // part of the last step already counted [s]
    Series series;
    bool not_requested;  // sums are not requested, and not computed
    bool known;          // `rates` are those of the end of the last step
    bool stale;          // `rates` are not those of the start of the step
    alignas(
        64) double rates[SUMS][MESHES];  // rates of the integrals at the end of a Rosenbrock step
    alignas(64) double normal_force[MESHES];  // there [N]
};

}  // namespace gearbox
