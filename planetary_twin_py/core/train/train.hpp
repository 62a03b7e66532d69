#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) Train {
    std::int64_t bodies;
    std::int64_t lanes;  // bodies or meshes, in whole registers
    std::int64_t axes;  // inputs, each with its rigid motion of the train
    alignas(64) double body_copies[16];  // bodies that move alike, of which an entry is one
    alignas(64) double mass[16];  // J/r^2 of all of them [kg]
    alignas(64) double radius[16];  // r of x = r theta [m]
    alignas(64) double inverse_radius[16];  // 1/r [1/m]
    alignas(64) double ratio[16][2];  // rigid speed per speed of each input [-]
    std::int64_t machines;
    std::int64_t coupling[3][2];  // machine and member
    double coupling_stiffness[3];  // in coordinates x [N/m]
    double coupling_damping[3];  // in coordinates x [N s/m]
    double cycles[2];  // mesh cycles per turn of each input, signed
    std::int64_t cycles_numerator[2];  // the same as a fraction
    std::int64_t cycles_denominator[2];
    std::int64_t sun;  // body or ground
    std::int64_t carrier;
    double sun_advance;  // mesh cycles per x of the sun [1/m]
    double carrier_advance;  // and per x of the carrier
    alignas(64) double lever[3][16];  // 1/r of the gears and the carrier of a mesh [1/m]
    bool friction;
    bool printed_torque;  // friction torque P/w instead of -f dVs/dw
    std::int64_t meshes;
    alignas(64) std::int64_t body[16][3];  // first gear, second gear, carrier
    alignas(64) double sign[16][3];  // of their x in d
    alignas(64) double copies[16];  // meshes alike that count in forces and powers on the train
    alignas(64) std::int64_t kind[16];
    alignas(64) double phase[16];  // delay in mesh cycles; whole cycles count teeth
    double stiffness[2];  // of one tooth pair, about [N/m]
    double stiffness_base[2];  // of the law of stiffness, see `tooth_pairs` [N/m]
    double stiffness_gain[2];
    double damping_time[2];  // tau of c = tau k [s]; 0: by the meshing frequency
    double damping_cycles;  // tau times meshing frequency [-]
    double lowest_frequency;  // [Hz]
    double base_pitch;  // [m]
    double rolling_advance;  // of the flanks at the pitch point in a mesh cycle [m]
    double pitch_curvature[2][2];  // radii of curvature at the pitch point, both gears [m]
    double external[2];  // +1: external, -1: internal
    std::int64_t segments[2];  // number of segments in a mesh cycle
    alignas(64) double edge[2][33];
    alignas(64) double shift[2][32][3];
    alignas(64) std::int64_t present[2][32];  // number of tooth pairs
    std::int64_t slots;  // tooth pairs of a mesh at most
    std::int64_t terms;  // of the polynomials below that are in use
    alignas(64) double weight[2][32][4][6];
    std::int64_t lines[2];
    std::int64_t harmonics[2];  // so many of them, the first, have no radial part
    alignas(64) double line_tangential[2][6];  // amplitude of the sine in e_T [m]
    alignas(64) double line_radial[2][6];  // amplitude of the cosine in e_R [m]
    alignas(64) double line_harmonic[2][6];  // sines ...
    alignas(64) std::int64_t line_period[2][6];  // ... in so many mesh cycles
    alignas(64) double line_phase[2][6];  // [rad]
    alignas(64) std::int64_t line_of_planet[2][6];  // 1: of a planet, whose turns its sun mesh counts
    std::int64_t faults;
    std::int64_t fault_teeth[4];  // of the gear with the fault
    alignas(64) std::int64_t fault_pair[4][16][2];  // pair on the drive and the coast side, or NOWHERE
    double fault_gap[4];  // missing material [m]
    alignas(64) double fault_factor[4][2][32][3][6];  // on the stiffness of the pair
    std::int64_t joints;  // bearings, and members with a drag of their own
    alignas(64) std::int64_t joint_body[19][2];  // what turns, and against what
    alignas(64) std::int64_t joint_planet[19];  // whose pin loads it, or NO_PLANET
    alignas(64) double joint_idle[19];  // f0 dm^3 [m^3]
    alignas(64) double joint_rubbing[19];  // f1 dm [m]
    alignas(64) double joint_coulomb[19];  // [N m]
    alignas(64) double joint_viscous[19];  // [N m s/rad]
    double pin_share;  // load on a pin per sum of the forces of its planet's meshes [-]
    std::int64_t discs;
    std::int64_t disc_body[3];
    double disc_radius[3];  // [m]
    double disc_gap;  // [m]
    double disc_fill;  // share of oil in what they turn in [-]
};

}  // namespace gearbox
