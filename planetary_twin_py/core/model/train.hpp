#pragma once

#include <cstdint>

#include "capacities.hpp"
#include "model/durability.hpp"
#include "model/moving_axes.hpp"

namespace gearbox {

// Bodies in coordinates x = r theta [m]; equal planets share an entry.
struct alignas(64) BodyArrays {
    alignas(64) double copies[BODIES];          // number of bodies of equal motion in one entry
    alignas(64) double mass[BODIES];            // J/r^2 of all of them [kg]
    alignas(64) double radius[BODIES];          // r [m]
    alignas(64) double inverse_radius[BODIES];  // 1/r [1/m]
    alignas(64) double ratio[AXES][BODIES];     // rigid speed per speed of each input [-]
};

// Shafts between the machines and their members.
struct alignas(64) Couplings {
    std::int64_t ends[MACHINES][2];  // machine and member
    double stiffness[MACHINES];      // in coordinates x [N/m]
    double damping[MACHINES];        // in coordinates x [N s/m]
};

// How the meshes go through their cycles as the train moves.
struct alignas(64) MeshCycle {
    double per_turn[AXES];         // mesh cycles per turn of each input, signed
    std::int64_t numerator[AXES];  // the same as a fraction
    std::int64_t denominator[AXES];
    double sun_advance;      // mesh cycles per x of the sun [1/m]
    double carrier_advance;  // mesh cycles per x of the carrier [1/m]
};

// Meshes in the equations of motion; those of equal planets share an entry.
struct alignas(64) MeshArrays {
    alignas(64) double lever[GEARS][MESHES];  // 1/r of the gears and the carrier [1/m]
    // Rigid speeds of both gears relative to the carrier, per speed of each input [-].
    alignas(64) double spin_ratio[GEARS - 1][AXES][MESHES];
    alignas(64) std::int64_t body[MESHES][ENTRIES];  // first gear, second gear, carrier, and where
                                                     // axes move the displacements of both gears
    alignas(64) double sign[MESHES][ENTRIES];        // of their x in d
    alignas(64) double copies[MESHES];               // number of equal meshes in one entry
    alignas(64) std::int64_t kind[MESHES];
    alignas(64) double phase[MESHES];             // delay in mesh cycles; whole cycles count teeth
    alignas(64) double stiffness_factor[MESHES];  // of the planet of a mesh [-]
};

// Damping of the meshes: tau of c = tau k.
struct alignas(64) MeshDamping {
    double time[KINDS];       // tau [s]; 0: by the meshing frequency
    double cycles;            // tau times meshing frequency [-]
    double lowest_frequency;  // [Hz]
};

// Paths of contact of both kinds of mesh.
struct alignas(64) ContactPaths {
    double coast_lead[KINDS];          // mesh cycles by which coast flanks follow drive flanks
    double base_pitch;                 // [m]
    double rolling_advance;            // of the flanks at the pitch point in a mesh cycle [m]
    double pitch_curvature[KINDS][2];  // radii of curvature at the pitch point, both gears [m]
    double external[KINDS];            // +1: external, -1: internal
};

// Stiffness and tooth pairs of both kinds of mesh, in the segments of a mesh cycle.
struct alignas(64) Teeth {
    double stiffness[KINDS];       // of one tooth pair, about [N/m]
    double stiffness_base[KINDS];  // of the law of stiffness, see `tooth_pairs` [N/m]
    double stiffness_gain[KINDS];
    std::int64_t slots;            // tooth pairs of a mesh at most
    std::int64_t terms;            // of the polynomials that are in use
    std::int64_t segments[KINDS];  // number of segments in a mesh cycle
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
    alignas(64) double weight[KINDS][SEGMENTS][PAIRS + 1][TERMS];
};

// Errors of form as lines: sines of the position of a mesh.
struct alignas(64) FormErrors {
    std::int64_t lines[KINDS];
    std::int64_t harmonics[KINDS];                 // number of the first lines, without radial part
    alignas(64) double tangential[MESHES][LINES];  // amplitude of the sine in e_T [m]
    alignas(64) double radial[MESHES][LINES];      // amplitude of the cosine in e_R [m]
    alignas(64) double harmonic[KINDS][LINES];     // number of sines in ...
    alignas(64) std::int64_t period[KINDS][LINES];     // ... this number of mesh cycles
    alignas(64) double phase[MESHES][LINES];           // [rad]
    alignas(64) std::int64_t of_planet[KINDS][LINES];  // 1: of a planet, by the turns at its sun
};

// Faulty teeth.
struct alignas(64) Faults {
    std::int64_t count;
    alignas(
        64) std::int64_t teeth[FAULTS];  // of the gear with the fault; 1: all teeth are identical
    alignas(64) std::int64_t each[FAULTS];             // 1: every tooth has its own gap
    alignas(64) std::int64_t pair[FAULTS][MESHES][2];  // on drive and coast side, or NOWHERE
    std::int64_t first_gap[FAULTS];                    // its entry, or that of tooth 0, in `gap`
    alignas(64) double gap[FAULT_GAPS];                // missing material [m]
    // Polynomials of the factor on a pair's stiffness: `pairs` of each segment, from `first_factor`
    // on, or NOWHERE.
    std::int64_t pairs;
    alignas(64) std::int64_t first_factor[FAULTS][KINDS];
    alignas(64) double factor[FAULT_FACTORS][TERMS];
};

// Bearings, and members with drag.
struct alignas(64) Joints {
    std::int64_t count;
    alignas(64) std::int64_t body[JOINTS][2];   // body, and the body it rotates against
    alignas(64) std::int64_t planet[JOINTS];    // planet that loads it, or NO_PLANET
    alignas(64) double no_load_factor[JOINTS];  // f0 dm^3 [m^3]
    alignas(64) double load_factor[JOINTS];     // f1 dm [m]
    alignas(64) double coulomb[JOINTS];         // [N m]
    alignas(64) double viscous[JOINTS];         // [N m s/rad]
    double pin_share;  // load on a pin per sum of the forces of its planet's meshes [-]
};

// Members that churn oil.
struct alignas(64) Discs {
    std::int64_t count;
    std::int64_t body[MEMBERS];
    double radius[MEMBERS];  // [m]
    double gap;              // [m]
    double fill;             // share of oil in the fluid around them [-]
};

// A gearbox as arrays that no run changes.
struct alignas(64) Train {
    std::int64_t bodies, meshes;
    std::int64_t lanes;     // bodies or meshes, in whole registers
    std::int64_t axes;      // inputs, each with its rigid motion of the train
    std::int64_t machines;  // each with a coupling
    std::int64_t sun;       // body or ground
    std::int64_t carrier;
    bool friction;
    bool printed_torque;  // friction torque P/w instead of -f dVs/dw
    BodyArrays body;
    Couplings coupling;
    MeshCycle cycle;
    MeshArrays mesh;
    MeshDamping damping;
    ContactPaths geometry;
    Teeth teeth;
    FormErrors errors;
    Faults faults;
    Joints joints;
    Discs discs;
    MovingAxes moving;
    Durability durability;
};

// Number of coordinates on which the transmission error of a mesh depends.
inline int entries_of(const Train& train) {
    return MOVING ? static_cast<int>(train.moving.entries) : ENTRIES;
}

}  // namespace gearbox
