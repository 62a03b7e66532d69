#pragma once

// Motion of the axes: coordinates of their displacements, and their bearings.
//
// Sun, ring and carrier are displaced by x and y from the axis of the housing, in a frame that
// rotates like the carrier without vibration. A planet is displaced by xi outwards and by eta
// across its radius (Lin and Parker 1999, J. Vib. Acoust. 121, 316), eta in the frame, so that it
// includes the displacement by the rotation of the carrier.
//
// Order of the meshes: drive flanks of all sun meshes, then of all ring meshes, then the coast
// flanks of both. Each is a separate entry that is closed on its side or open, so that both flanks
// of a mesh may touch simultaneously. Its row is T + R on the drive side and T - R on the coast
// side, T the transmission error and R the approach of the flanks of both sides.
//
// Axes that tilt have axial displacements z, and tilts about x and y, of planets about xi and eta,
// as arc lengths at the radius of the rotations.

#include <cstdint>

#include "capacities.hpp"
#include "model/rolling_bearing.hpp"

namespace gearbox {

constexpr int SLOPES = 4;           // tilts of the first and of the second gear
constexpr int CARRIER_BEARING = 2;  // index of the bearing of the carrier

// Axial and tilting motion of the body on a bearing.
struct TiltingAxis {
    std::int64_t axial;        // coordinate z
    std::int64_t place[2];     // coordinates of the tilts
    double lever;              // tilt per coordinate [1/m]
    std::int64_t turns;        // body or ground with the speed of the spin
    double axial_stiffness;    // [N/m]
    double axial_damping;      // [N s/m]
    double tilting_stiffness;  // [N m/rad]
    double tilting_damping;    // [N m s/rad]
    double diametral;          // moment of inertia [kg m^2]
    double polar;              // [kg m^2]
};

// A pit in a rolling bearing, see `bearing_pits.hpp`. Angles of cage and pit are those of
// displacements of the body on the bearing.
struct BearingPit {
    std::int64_t bearing;
    std::int64_t body;          // coordinate of the rotation of the body on the bearing
    std::int64_t roller;        // 1: in a roller, 0: in a race
    double count;               // of elements
    double strength;            // load of an element per deflection^n [N/m^n]
    double exponent;            // n
    double depth;               // [m]
    double half_width;          // half the angle of the pit, of a roller about its own axis [rad]
    double per_turn[2];         // turns of cage and pit per turn of the body against its support
    double start[2];            // their angles at the start [rad]
    double per_motor[2][AXES];  // their turns per turn of each motor
    std::int64_t numerator[2][AXES];  // the same as fractions, without whole turns
    std::int64_t denominator[2][AXES];
};

struct alignas(64) MovingAxes {
    std::int64_t bearings;            // sun, ring, carrier, then planets
    std::int64_t frame;               // coordinate without motion, rotating with the frame
    std::int64_t place[BEARINGS][2];  // coordinates of the displacements of the body on a bearing
    std::int64_t leads[BEARINGS];     // 1: the first bearing with these coordinates, else 0
    std::int64_t carrier[2];          // those of the carrier, the support of the planet bearings
    double direction[BEARINGS][2];    // cosine and sine of the position of a planet; 0 in housing
    double carried[BEARINGS];         // motion of a pin per x of the carrier [-]; 0 in housing
    double mass[BEARINGS];            // [kg]
    double stiffness[BEARINGS];       // radial [N/m]; of a rolling bearing, under nominal load
    double damping[BEARINGS];         // [N s/m]
    double clearance[BEARINGS];       // radial [m]
    RollingBearing rolling[BEARINGS];
    double centre[BEARINGS][2];         // displacement in the centred position [m]
    double arm;                         // radius of the planet centres [m]
    double gravity;                     // [m/s^2], 0 without weight
    double downwards;                   // direction of gravity from x of the housing [rad]
    std::int64_t turn_numerator[AXES];  // turns of the frame per turn of each motor, as a fraction
    std::int64_t turn_denominator[AXES];
    alignas(64) double line[MESHES][ENTRIES];  // rotation of the line of action by x [1/m]
    std::int64_t entries;  // of the rows of the meshes; with axial motion and tilts or without
    TiltingAxis tilting[BEARINGS];
    // Relative slope of the flanks of a mesh along the face, per tilt [1/m], and a twelfth of the
    // square of the face width [m^2].
    alignas(64) std::int64_t slope_place[MESHES][SLOPES];
    alignas(64) double slope[MESHES][SLOPES];
    double face_square;
    std::int64_t pits;
    BearingPit pit[PITS];
};

}  // namespace gearbox
