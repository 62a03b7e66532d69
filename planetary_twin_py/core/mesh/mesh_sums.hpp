#pragma once

#include "capacities.hpp"

namespace gearbox {

struct alignas(64) MeshSums {
    double time;                                // length of the stretch [s]
    bool damaging;                              // whether damage and extremes are counted
    alignas(64) double integral[SUMS][MESHES];  // over it
    alignas(64) double dte_peak[MESHES];        // largest magnitude [m]
    alignas(64) double force_peak[MESHES];      // largest magnitude [N]
    alignas(64) double damage[DAMAGES][MESHES];
    alignas(64) double extreme[EXTREMES][MESHES];
};

}  // namespace gearbox
