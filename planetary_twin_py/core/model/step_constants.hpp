#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

// Torque of a machine within a step: `torque + rate t` where it turns with the frame [N m, N m/s],
// less `gain` times its speed relative to that [N m s/rad].
struct Drive {
    double torque, rate, gain;
};

struct alignas(64) StepConstants {
    alignas(64) double start[MESHES];  // fraction of the mesh cycle at the start of the step
    alignas(64) double side[MESHES];   // +1, -1, or 0: open
    alignas(64) std::int64_t segment[MESHES];  // 1 + segment of the following arrays, 0: not set
    alignas(64) double low[MESHES];            // edges of the segment [cycles]
    alignas(64) double high[MESHES];
    alignas(64) double lead[MESHES];  // of coast flanks before drive flanks [cycles]
    alignas(64) double base[MESHES];  // law of stiffness [N/m]
    alignas(64) double gain[MESHES];
    alignas(64) double fixed_damping_time[MESHES];        // part independent of the speed [s]
    alignas(64) double external[MESHES];                  // +1: external mesh, -1: internal
    alignas(64) double weight[PAIRS + 1][TERMS][MESHES];  // polynomials, see `mesh.tooth_pairs`
    alignas(
        64) double rho1[PAIRS][MESHES];  // radii of curvature of the pairs where the cycle is 0 [m]
    alignas(64) double rho2[PAIRS][MESHES];
    alignas(64) double travel[PAIRS][MESHES];  // of the contact per motion of the teeth
    alignas(64) double face[PAIRS][MESHES];    // part of the face in contact where the cycle is 0
    alignas(64) double face_growth[PAIRS][MESHES];  // per cycle
    alignas(64) double damping_time[MESHES];        // of each mesh at the start [s]
    double tau[KINDS];                 // damping time of each kind of mesh at the start [s]
    double cycle_rate;                 // mesh cycles per second of the frame, signed
    alignas(64) double rigid[BODIES];  // speeds of the frame [rad/s]
    alignas(64) double spin[GEARS - 1][MESHES];  // of the gears with the frame [rad/s]
    double slew[AXES];                           // of the speed set-points [rad/s^2]
    double torque[MACHINES];                     // of the load at the start [N m]
    Drive drive[MACHINES];
    alignas(64) double line_angle[MESHES][LINES];     // of the errors of form at the start [rad]
    alignas(64) std::uint64_t faulty[MESHES][PAIRS];  // faults that change the stiffness of a pair
    alignas(64) double gap[MESHES][PAIRS];            // missing material of a tooth pair [m]
};

}  // namespace gearbox
