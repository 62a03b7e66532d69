#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) StepConstants {
    alignas(64) double start[16];  // fraction of the mesh cycle at the start of the step
    alignas(64) double side[16];  // +1, -1, or 0: open
    alignas(64) std::int64_t segment[16];  // 1 + that which the following arrays are of, 0: none yet
    alignas(64) double low[16];  // edges of the segment [cycles]
    alignas(64) double high[16];
    alignas(64) double base[16];  // law of stiffness [N/m]
    alignas(64) double gain[16];
    alignas(64) double fixed[16];  // damping time that does not follow the speed [s]
    alignas(64) double external[16];  // +1: external mesh, -1: internal
    alignas(64) double weight[4][6][16];  // polynomials, see `mesh.tooth_pairs`
    alignas(64) double rho1[3][16];  // radii of curvature of the pairs where the cycle is 0 [m]
    alignas(64) double rho2[3][16];
    double tau[2];  // damping time of each kind of mesh at the start [s]
    double cycle_rate;  // mesh cycles per second of the frame, signed
    alignas(64) double rigid[16];  // speeds of the frame [rad/s]
    double slew[2];  // of the speed set-points [rad/s^2]
    alignas(64) double line_angle[16][6];  // of the errors of form at the start [rad]
    alignas(64) std::int8_t faulty[16][3][4];  // which tooth pairs have which fault
};

}  // namespace gearbox
