#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) ContactSums {
    alignas(64) double share[64];  // of the mesh force [s]
    alignas(64) double film[64];  // by that share [m s]
    alignas(64) double boundary[64];  // [N s]
    alignas(64) double viscous[64];  // [N s]
    alignas(64) double lost[64];  // [J]
    alignas(64) double touching[16];  // [s]
    alignas(64) double clipped[16];  // [s]
    alignas(64) double rolled[16];  // through the mesh [J]
};

}  // namespace gearbox
