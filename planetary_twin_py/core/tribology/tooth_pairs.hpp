#pragma once

#include <cstdint>

#include "rooms.hpp"

namespace gearbox {

struct alignas(64) ToothPairs {
    std::int64_t count;
    double
        slowest_rolling;  // that sets the least width of the layer in which friction reverses [m/s]
    alignas(64) double share[ROOM];  // of the mesh force [-]
    alignas(64) double rho1[ROOM];   // radii of curvature [m]
    alignas(64) double rho2[ROOM];
    alignas(64) double external[ROOM];  // +1: external mesh, -1: internal
    alignas(64) double speed1[ROOM];    // of the gears relative to the carrier [rad/s]
    alignas(64) double speed2[ROOM];
    alignas(64) double load[ROOM];           // [N]
    alignas(64) double face[ROOM];           // part of the face that carries it; 0: not known, all
    alignas(64) double friction[ROOM];       // signed, against the sliding [N]
    alignas(64) double boundary[ROOM];       // [N]
    alignas(64) double viscous[ROOM];        // [N]
    alignas(64) double log_film[ROOM];       // logarithm of the film thickness in metres
    alignas(64) double sliding[ROOM];        // [m/s]
    alignas(64) double slope[ROOM];          // of friction over sliding [N s/m]
    alignas(64) double rolling[ROOM];        // rolling resistance, signed [N]
    alignas(64) double rolling_power[ROOM];  // that it takes [W]
    bool held;  // whether bristles join the flanks, see `bristles`; then, of each pair:
    alignas(64) double bristle[ROOM];        // share of the full friction [-]
    alignas(64) double full[ROOM];           // that friction [N]
    alignas(64) double bristle_rate[ROOM];   // of the share [1/s]
    alignas(64) double bristle_decay[ROOM];  // by which that falls as the share grows [1/s]
    alignas(64) double bristle_gain[ROOM];   // by which it grows with the sliding [1/m]
    alignas(64) double lost[ROOM];           // power that is not stored in the bristles [W]
};

struct alignas(64) DragOfMeshes {
    alignas(64) double torque[GEARS][MESHES];  // on both gears and on the line of action [N m]
    alignas(64) double power[MESHES];          // lost [W]
};

}  // namespace gearbox
