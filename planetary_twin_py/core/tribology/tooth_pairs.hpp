#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) ToothPairs {
    std::int64_t count;
    double slowest_rolling;  // that sets the least width of the layer in which friction reverses [m/s]
    alignas(64) double share[64];  // of the mesh force [-]
    alignas(64) double rho1[64];  // radii of curvature [m]
    alignas(64) double rho2[64];
    alignas(64) double external[64];  // +1: external mesh, -1: internal
    alignas(64) double speed1[64];  // of the gears relative to the carrier [rad/s]
    alignas(64) double speed2[64];
    alignas(64) double load[64];  // [N]
    alignas(64) double friction[64];  // signed, against the sliding [N]
    alignas(64) double boundary[64];  // [N]
    alignas(64) double viscous[64];  // [N]
    alignas(64) double log_film[64];  // logarithm of the film thickness in metres
    alignas(64) double sliding[64];  // [m/s]
    alignas(64) double slope[64];  // of friction over sliding [N s/m]
    alignas(64) double rolling[64];  // rolling resistance, signed [N]
    alignas(64) double rolling_power[64];  // that it takes [W]
    bool held;  // whether bristles join the flanks, see `bristles`; then, of each pair:
    alignas(64) double bristle[64];  // share of the full friction [-]
    alignas(64) double full[64];  // that friction [N]
    alignas(64) double bristle_rate[64];  // of the share [1/s]
    alignas(64) double bristle_decay[64];  // by which that falls as the share grows [1/s]
    alignas(64) double bristle_gain[64];  // by which it grows with the sliding [1/m]
    alignas(64) double lost[64];  // power that is not stored in the bristles [W]
};

struct alignas(64) DragOfMeshes {
    alignas(64) double torque[3][16];  // [N m]
    alignas(64) double power[16];  // lost [W]
};

}  // namespace gearbox
