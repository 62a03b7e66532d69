#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) MeshSums {
    double time;  // length of the stretch [s]
    alignas(64) double integral[12][16];  // over it
    alignas(64) double dte_peak[16];  // largest magnitude [m]
    alignas(64) double force_peak[16];  // largest magnitude [N]
};

}  // namespace gearbox
