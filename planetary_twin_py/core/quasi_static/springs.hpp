#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) Springs {
    alignas(64) double copies[16];  // planets with the same motion, of which it is one
    alignas(
        64) double error[16];  // errors of form, and what `friction` squeezes the sun mesh by [m]
    alignas(64) double compliance[16];  // of both meshes in series [m/N]
    alignas(64) double friction[16];    // what rubs on the planet [N]
    alignas(64) double steps[16][3];    // see `ring_force` [m]
};

}  // namespace gearbox
