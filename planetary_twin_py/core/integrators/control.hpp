#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) Control {
    double tolerance;                   // relative to the deflection of the meshes
    double deflection;                  // under the torques of steady running [m]
    double acceleration_deflection[2];  // and under each acceleration of a set-point [m s^2/rad]
    double speed_per_deflection;        // speed of a body per deflection [1/s]
    double tolerance_x;   // local error this step may make in a transmission error [m]
    double tolerance_v;   // and in the speed of a body [m/s]
    bool creeping;        // tooth pairs hold, see `dynamics.bristles`
    bool slow;            // the layer in which friction reverses limits the errors of speeds
    double next_step;     // [s]
    double step;          // the last one taken [s]
    double longest;       // [s]
    std::int64_t method;  // AUTO, COLLOCATION or ROSENBROCK
    bool collocated;      // how the last step was made
    std::int64_t fallback_steps;  // steps still to be made by the other method
    double next_stiff;            // next step of that [s]
    bool changed;                 // contacts or loads are no longer those of the last evaluation
    std::int64_t steps;
    std::int64_t repeated;     // steps of steady running that were not made again, see `periodic`
    std::int64_t stiff_steps;  // of them by Rosenbrock's method
    std::int64_t rejected;
    std::int64_t evaluations;
    std::int64_t pair_events;
    std::int64_t flank_events;
    std::int64_t reversals;    // steps in which vibration may reverse friction, see `creep`
    std::int64_t both_flanks;  // steps in which both flanks of a mesh touch
};

}  // namespace gearbox
