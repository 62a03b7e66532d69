#pragma once

// What follows from the operating point and the commands: the backlash, and what acts on the
// shafts.

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

// Backlash of all meshes along the line of action, by its law.
struct Backlash {
    double half;           // [m]
    double offset;         // transmission error from which the force grows [m]
    double inner_squared;  // square of the deflection at which flanks come into contact [m^2]
    double release;        // 1: flanks separate at zero force, 0: at half the backlash
};

struct alignas(64) Operation {
    Backlash backlash;
    double target_speed[AXES];   // [rad/s]
    double slew_rate;            // [rad/s^2]
    double torque[MACHINES];     // mean torque of each machine without losses, or given torque
                                 // [N m]
    double ripple;               // fluctuation of the first motor's [N m]
    double ripple_order;         // cycles per turn of that motor
    double inertia[AXES][AXES];  // of the whole train at the motors [kg m^2]
    double proportional[AXES];   // speed loop, at the motor [N m s/rad]
    double trim_gain[MACHINES][AXES];  // speed loop, torque per trim [N m/rad]
    double load_proportional;          // speed loop, at a load with speed control [N m s/rad]
    std::int64_t port[MACHINES];       // BY_MACHINE, BY_TORQUE or BY_MOTION
    std::int64_t since_seconds;        // the instant at which `torque` and `speed` are given
    double since;                      // and the time since whole seconds [s]
    double torque_rate[MACHINES];      // rate of change of a given torque [N m/s]
    double speed[MACHINES];            // of a shaft with given motion [rad/s]
    double acceleration[MACHINES];     // rate of change of this speed [rad/s^2]
    std::int64_t reaches_position[MACHINES];  // 1: the shaft reaches a given position at this speed
    double speed_after[MACHINES];             // its speed after that, until a command [rad/s]
};

}  // namespace gearbox
