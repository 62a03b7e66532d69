#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

struct alignas(64) ToothPairs {
    std::int64_t count;
    double
        slowest_rolling;  // that sets the least width of the layer in which friction reverses [m/s]
    alignas(64) double share[PAIR_CAPACITY];  // of the mesh force [-]
    alignas(64) double rho1[PAIR_CAPACITY];   // radii of curvature [m]
    alignas(64) double rho2[PAIR_CAPACITY];
    alignas(64) double external[PAIR_CAPACITY];  // +1: external mesh, -1: internal
    alignas(64) double speed1[PAIR_CAPACITY];    // of the gears relative to the carrier [rad/s]
    alignas(64) double speed2[PAIR_CAPACITY];
    alignas(64) double load[PAIR_CAPACITY];           // [N]
    alignas(64) double face[PAIR_CAPACITY];           // loaded part of the face; 0: not known
    alignas(64) double friction[PAIR_CAPACITY];       // signed, against the sliding [N]
    alignas(64) double boundary[PAIR_CAPACITY];       // [N]
    alignas(64) double viscous[PAIR_CAPACITY];        // [N]
    alignas(64) double log_film[PAIR_CAPACITY];       // logarithm of the film thickness in metres
    alignas(64) double sliding[PAIR_CAPACITY];        // [m/s]
    alignas(64) double slope[PAIR_CAPACITY];          // of friction over sliding [N s/m]
    alignas(64) double rolling[PAIR_CAPACITY];        // rolling resistance, signed [N]
    alignas(64) double rolling_power[PAIR_CAPACITY];  // power lost to it [W]
    bool has_bristles;  // whether pairs have bristles, see `bristles.hpp`; then, of each pair:
    alignas(64) double bristle[PAIR_CAPACITY];        // share of the full friction [-]
    alignas(64) double full[PAIR_CAPACITY];           // full friction [N]
    alignas(64) double bristle_rate[PAIR_CAPACITY];   // of the share [1/s]
    alignas(64) double bristle_decay[PAIR_CAPACITY];  // -d(rate)/d(share) [1/s]
    alignas(64) double bristle_gain[PAIR_CAPACITY];   // d(rate)/d(sliding) [1/m]
    alignas(64) double lost[PAIR_CAPACITY];  // dissipated power, without that stored in the
                                             // bristles [W]
};

struct alignas(64) DragOfMeshes {
    alignas(64) double torque[GEARS][MESHES];  // on both gears and on the line of action [N m]
    alignas(64) double power[MESHES];          // lost [W]
};

}  // namespace gearbox
