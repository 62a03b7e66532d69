#pragma once

#include <cstdint>

#include "capacities.hpp"
#include "model/moving_axes.hpp"

namespace gearbox {

struct alignas(64) Train {
    std::int64_t bodies;
    std::int64_t lanes;                         // bodies or meshes, in whole registers
    std::int64_t axes;                          // inputs, each with its rigid motion of the train
    alignas(64) double body_copies[BODIES];     // number of bodies of equal motion in one entry
    alignas(64) double mass[BODIES];            // J/r^2 of all of them [kg]
    alignas(64) double radius[BODIES];          // r of x = r theta [m]
    alignas(64) double inverse_radius[BODIES];  // 1/r [1/m]
    alignas(64) double ratio[AXES][BODIES];     // rigid speed per speed of each input [-]
    // Rigid speeds of both gears of a mesh relative to its carrier, per speed of each input [-].
    alignas(64) double spin_ratio[GEARS - 1][AXES][MESHES];
    std::int64_t machines;
    std::int64_t coupling[MACHINES][2];   // machine and member
    double coupling_stiffness[MACHINES];  // in coordinates x [N/m]
    double coupling_damping[MACHINES];    // in coordinates x [N s/m]
    double cycles[AXES];                  // mesh cycles per turn of each input, signed
    std::int64_t cycles_numerator[AXES];  // the same as a fraction
    std::int64_t cycles_denominator[AXES];
    std::int64_t sun;  // body or ground
    std::int64_t carrier;
    double sun_advance;                       // mesh cycles per x of the sun [1/m]
    double carrier_advance;                   // mesh cycles per x of the carrier [1/m]
    alignas(64) double lever[GEARS][MESHES];  // 1/r of the gears and the carrier of a mesh [1/m]
    bool friction;
    bool printed_torque;  // friction torque P/w instead of -f dVs/dw
    std::int64_t meshes;
    alignas(64) std::int64_t body[MESHES][ENTRIES];  // first gear, second gear, carrier, and where
                                                     // axes move the displacements of both gears
    alignas(64) double sign[MESHES][ENTRIES];        // of their x in d
    alignas(64) double copies[MESHES];               // number of equal meshes in one entry
    alignas(64) std::int64_t kind[MESHES];
    alignas(64) double phase[MESHES];  // delay in mesh cycles; whole cycles count teeth
    double coast_lead[KINDS];          // mesh cycles by which coast flanks follow drive flanks
    double stiffness[KINDS];           // of one tooth pair, about [N/m]
    double stiffness_base[KINDS];      // of the law of stiffness, see `tooth_pairs` [N/m]
    double stiffness_gain[KINDS];
    alignas(64) double stiffness_factor[MESHES];  // on both, of the planet of a mesh [-]
    double damping_time[KINDS];        // tau of c = tau k [s]; 0: by the meshing frequency
    double damping_cycles;             // tau times meshing frequency [-]
    double lowest_frequency;           // [Hz]
    double base_pitch;                 // [m]
    double rolling_advance;            // of the flanks at the pitch point in a mesh cycle [m]
    double pitch_curvature[KINDS][2];  // radii of curvature at the pitch point, both gears [m]
    double external[KINDS];            // +1: external, -1: internal
    std::int64_t segments[KINDS];      // number of segments in a mesh cycle
    alignas(64) double edge[KINDS][SEGMENTS + 1];
    // Distance of a pair from the first [base pitches]; its fraction identifies the part of a pair.
    alignas(64) double shift[KINDS][SEGMENTS][PAIRS];
    // Contact of a pair, at centre + travel * cycle [base pitches]: see `mesh/overlap.py`.
    alignas(64) double centre[KINDS][SEGMENTS][PAIRS];
    alignas(64) double travel[KINDS][SEGMENTS][PAIRS];
    // Part of the face in contact, face + face_growth * cycle.
    alignas(64) double face[KINDS][SEGMENTS][PAIRS];
    alignas(64) double face_growth[KINDS][SEGMENTS][PAIRS];
    alignas(64) std::int64_t present[KINDS][SEGMENTS];  // number of tooth pairs
    std::int64_t slots;                                 // tooth pairs of a mesh at most
    std::int64_t terms;                                 // of the polynomials below that are in use
    alignas(64) double weight[KINDS][SEGMENTS][PAIRS + 1][TERMS];
    std::int64_t lines[KINDS];
    std::int64_t harmonics[KINDS];  // number of the first lines, without radial part
    alignas(64) double line_tangential[MESHES][LINES];   // amplitude of the sine in e_T [m]
    alignas(64) double line_radial[MESHES][LINES];       // amplitude of the cosine in e_R [m]
    alignas(64) double line_harmonic[KINDS][LINES];      // number of sines in ...
    alignas(64) std::int64_t line_period[KINDS][LINES];  // ... this number of mesh cycles
    alignas(64) double line_phase[MESHES][LINES];        // [rad]
    alignas(64) std::int64_t
        line_of_planet[KINDS][LINES];  // 1: of a planet, by the turns at its sun mesh
    std::int64_t faults;
    std::int64_t fault_teeth[FAULTS];  // of the gear with the fault
    alignas(64) std::int64_t
        fault_pair[FAULTS][MESHES][2];  // pair on the drive and the coast side, or NOWHERE
    double fault_gap[FAULTS];           // missing material [m]
    alignas(64) double fault_factor[FAULTS][KINDS][SEGMENTS][PAIRS]
                                   [TERMS];           // on the stiffness of the pair
    std::int64_t joints;                              // number of bearings, and members with drag
    alignas(64) std::int64_t joint_body[JOINTS][2];   // body, and the body it rotates against
    alignas(64) std::int64_t joint_planet[JOINTS];    // planet that loads it, or NO_PLANET
    alignas(64) double joint_no_load_factor[JOINTS];  // f0 dm^3 [m^3]
    alignas(64) double joint_load_factor[JOINTS];     // f1 dm [m]
    alignas(64) double joint_coulomb[JOINTS];         // [N m]
    alignas(64) double joint_viscous[JOINTS];         // [N m s/rad]
    double pin_share;  // load on a pin per sum of the forces of its planet's meshes [-]
    std::int64_t discs;
    std::int64_t disc_body[MEMBERS];
    double disc_radius[MEMBERS];  // [m]
    double disc_gap;              // [m]
    double disc_fill;             // share of oil in the fluid around them [-]
    MovingAxes moving;
};

// Number of coordinates on which the transmission error of a mesh depends.
inline int entries_of(const Train& train) {
    return MOVING ? static_cast<int>(train.moving.entries) : ENTRIES;
}

}  // namespace gearbox
