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
    MeshSums step;   // over the last step
    MeshSums part;   // over a part of it
    MeshSums total;  // since it was popped, up to the start of the last step
    double taken;    // of the last step [s]
    Series series;
    bool not_requested;  // no one asks for sums: steps have none
    bool known;          // `rates` are those of the end of the last step
    bool stale;          // `rates` are not those of the start of the step
    alignas(
        64) double rates[SUMS][MESHES];  // by which the integrals grow at the end of a stiff step
    alignas(64) double normal_force[MESHES];  // there [N]
};

}  // namespace gearbox
