#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

struct alignas(64) State {
    alignas(64) double x[BODIES];               // [m]
    alignas(64) double v[BODIES];               // [m/s]
    alignas(64) std::int64_t side[MESHES];      // DRIVE_SIDE, OPEN or COAST_SIDE
    alignas(64) std::int64_t segment[MESHES];   // of the table of tooth pairs
    std::int64_t seconds;                       // whole ones since the start
    double time;                                // since then [s]
    double turns[AXES];                         // whole turns of each motor
    double fraction[AXES];                      // of a turn, in [0, 1)
    double speed[AXES];                         // of each motor [rad/s]
    double trim[AXES];                          // integral of the speed error [rad]
    double set_speed[AXES];                     // slewed set-point [rad/s]
    alignas(64) double energy[LEDGER];          // [J], [N m s]
    alignas(64) double bristle[PAIR_CAPACITY];  // of the tooth pairs with bristles: share of
                                                // full friction [-]
};

}  // namespace gearbox
