#pragma once

#include "capacities.hpp"

namespace gearbox {

struct alignas(64) MeshesNow {
    double advance;                            // mesh cycles since the start of the step
    double cycle_rate;                         // mesh cycles per second
    double speed_damping_time;                 // part that follows the rate at which teeth pass [s]
    alignas(64) double d[MESHES];              // transmission error, less the error of form [m]
    alignas(64) double rate[MESHES];           // of it [m/s]
    alignas(64) double error_rate[MESHES];     // of the error of form [m/s]
    alignas(64) double normal_force[MESHES];   // force, 0 if open [N]
    alignas(64) double damping_power[MESHES];  // lost to damping [W]
    alignas(64) double stiffness_power[MESHES];  // of changing stiffness and errors of form [W]
    // Where axes move: stiffness [N/m] and its growth [N/(m s)]; where they tilt, the moment
    // against the slope of the flanks [N m].
    alignas(64) double stiffness[MESHES];
    alignas(64) double stiffening[MESHES];
    alignas(64) double moment[MESHES];
    alignas(64) double share[PAIRS][MESHES];  // of the tooth pairs in the force [-]
    alignas(64) double load[PAIRS][MESHES];   // of the tooth pairs [N]
};

}  // namespace gearbox
