#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) Control {
    double tolerance;                   // relative to the deflection of the meshes
    double deflection;                  // under the torques of steady running [m]
    double elastic_deflection;          // of it, without half the backlash [m]
    double acceleration_deflection[2];  // and per acceleration of each set-point [m s^2/rad]
    double speed_per_deflection;        // speed of a body per deflection [1/s]
    double tolerance_x;  // allowed local error of a transmission error in this step [m]
    double tolerance_v;  // and of the speed of a body [m/s]
    bool creeping;  // the gears creep, so tooth pairs have bristles, see `lubrication/bristles.hpp`
    bool friction_limits_speed;   // errors of speeds, to the range in which friction reverses
    double next_step;             // [s]
    double step;                  // last accepted step [s]
    double longest;               // [s]
    std::int64_t method;          // AUTO, COLLOCATION or ROSENBROCK
    bool collocated;              // whether the last step was one of collocation
    std::int64_t fallback_steps;  // number of next steps by Rosenbrock's method
    double next_stiff;            // next step of Rosenbrock's method [s]
    bool changed;                 // contacts or loads have changed since the last evaluation
    std::int64_t steps;
    std::int64_t repeated;     // replayed steps, see `periodic.hpp`
    std::int64_t stiff_steps;  // of them by Rosenbrock's method
    std::int64_t rejected;
    std::int64_t evaluations;
    std::int64_t pair_events;
    std::int64_t flank_events;
    std::int64_t reversals;    // steps in which vibration may reverse friction, see `creep.hpp`
    std::int64_t both_flanks;  // steps in which both flanks of a mesh touch
};

}  // namespace gearbox
