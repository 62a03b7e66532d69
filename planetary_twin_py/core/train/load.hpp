#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

struct alignas(64) Load {
    double half_backlash;              // where flanks meet [m]
    double offset;                     // transmission error from which the force grows [m]
    double inner_squared;              // deflection at which flanks meet, squared [m^2]
    double release;                    // 1: flanks part where the force vanishes, 0: where they met
    double target_speed[AXES];         // [rad/s]
    double slew_rate;                  // [rad/s^2]
    double torque[MACHINES];           // mean torque of each machine without loss, or as given
                                       // [N m]
    double ripple;                     // fluctuation of the first motor's [N m]
    double ripple_order;               // cycles per turn of that motor
    double inertia[AXES][AXES];        // of the whole train at the motors [kg m^2]
    double proportional[AXES];         // speed loop, at the motor [N m s/rad]
    double trim_gain[MACHINES][AXES];  // speed loop, torque per trim [N m/rad]
    double load_proportional;          // speed loop, at a load that holds the speed [N m s/rad]
    std::int64_t port[MACHINES];       // BY_MACHINE, BY_TORQUE or BY_MOTION
    std::int64_t since_seconds;        // the instant of which `torque` and `speed` are
    double since;                      // and beyond whole seconds [s]
    double torque_rate[MACHINES];      // by which a given torque changes [N m/s]
    double speed[MACHINES];            // of a shaft whose motion is given [rad/s]
    double acceleration[MACHINES];     // by which that changes [rad/s^2]
    std::int64_t arrives[MACHINES];    // 1: the shaft reaches a given position at this speed
    double speed_after[MACHINES];      // its speed after that, until a command [rad/s]
};

}  // namespace gearbox
