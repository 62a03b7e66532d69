#pragma once

#include "capacities.hpp"

namespace gearbox {

struct alignas(64) MeshSums {
    double time;                                // length of the stretch [s]
    alignas(64) double integral[SUMS][MESHES];  // over it
    alignas(64) double dte_peak[MESHES];        // largest magnitude [m]
    alignas(64) double force_peak[MESHES];      // largest magnitude [N]
};

}  // namespace gearbox
