#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) State {
    alignas(64) double x[16];  // [m]
    alignas(64) double v[16];  // [m/s]
    alignas(64) std::int64_t side[16];  // DRIVE_SIDE, OPEN or COAST_SIDE
    alignas(64) std::int64_t segment[16];  // of the table of tooth pairs
    std::int64_t seconds;  // whole ones since the start
    double time;  // since then [s]
    double turns[2];  // whole turns of each motor
    double fraction[2];  // of a turn, in [0, 1)
    double speed[2];  // of each motor [rad/s]
    double trim[2];  // integral of the speed error [rad]
    double set_speed[2];  // slewed set-point [rad/s]
    alignas(64) double energy[11];  // [J], [N m s]
    alignas(64) double bristle[64];  // of the tooth pairs, while they hold: share of full friction [-]
};

}  // namespace gearbox
