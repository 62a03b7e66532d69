#pragma once

#include <cstdint>
#include <vector>

#include "capacities.hpp"

namespace gearbox {

// A tooth pair that has left a mesh, and those after it that repeat its passage.
struct Passed {
    std::int64_t mesh;
    std::int64_t side;
    std::int64_t pair;               // its number, see `faults.hpp`
    std::int64_t times;              // passages
    std::int64_t stride;             // from the pair of one to that of the next
    double damage[2 * ROOT_DAMAGE];  // of one, in the order of the rows of the damage
};

struct alignas(64) MeshSums {
    double time;                                // length of the stretch [s]
    bool damaging;                              // whether damage and extremes are counted
    alignas(64) double integral[SUMS][MESHES];  // over it
    alignas(64) double dte_peak[MESHES];        // largest magnitude [m]
    alignas(64) double force_peak[MESHES];      // largest magnitude [N]
    alignas(64) double damage[DAMAGES][MESHES];
    alignas(64) double extreme[EXTREMES][MESHES];
    std::vector<Passed> passed;  // where damage of single teeth is asked for
};

}  // namespace gearbox
