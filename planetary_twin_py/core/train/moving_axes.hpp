#pragma once

// How the axes move: which coordinates are displacements, and the bearings that hold them.
//
// Sun, ring and carrier are displaced by x and y from the axis of the housing, in a frame that
// turns as the carrier does without vibration. A planet is displaced by xi outwards and by eta
// across its radius (Lin and Parker 1999, J. Vib. Acoust. 121, 316), eta in the frame, so that it
// holds the way that the carrier turns it along.
//
// Order of the meshes: drive flanks of all sun meshes, then of all ring meshes, then the coast
// flanks of both. Each is an entry of its own that is closed on its side or open, so that both
// flanks of a mesh may touch at once. Its row is T + R on the drive side and T - R on the coast
// side, T the transmission error and R what brings the flanks of both sides closer.
//
// Axes that tilt have axial displacements z, and tilts about x and y, of planets about xi and eta,
// as ways on the circle whose radius is that of the turns.

#include <cstdint>

#include "capacities.hpp"
#include "train/rolling_bearing.hpp"

namespace gearbox {

constexpr int SLOPES = 4;           // tilts of the first and of the second gear
constexpr int CARRIER_BEARING = 2;  // place of that of the carrier

// Axial and tilting motion of what a bearing holds.
struct TiltingAxis {
    std::int64_t axial;        // coordinate z
    std::int64_t place[2];     // coordinates of the tilts
    double lever;              // tilt per coordinate [1/m]
    std::int64_t turns;        // body or ground, whose speed the spin is
    double axial_stiffness;    // [N/m]
    double axial_damping;      // [N s/m]
    double tilting_stiffness;  // [N m/rad]
    double tilting_damping;    // [N m s/rad]
    double diametral;          // moment of inertia [kg m^2]
    double polar;              // [kg m^2]
};

struct alignas(64) MovingAxes {
    std::int64_t bearings;            // sun, ring, carrier, then planets
    std::int64_t frame;               // coordinate without motion that turns with the frame
    std::int64_t place[BEARINGS][2];  // coordinates of the displacements of what a bearing holds
    std::int64_t leads[BEARINGS];     // 1: the first of those that share coordinates, else 0
    std::int64_t carrier[2];          // those of the carrier, on which the bearings of planets are
    double direction[BEARINGS][2];    // cosine and sine of the position of a planet; 0 in housing
    double carried[BEARINGS];         // way of a pin per x of the carrier [-]; 0 in housing
    double mass[BEARINGS];            // [kg]
    double stiffness[BEARINGS];       // radial [N/m]; of a rolling bearing, under nominal load
    double damping[BEARINGS];         // [N s/m]
    double clearance[BEARINGS];       // radial [m]
    RollingBearing rolling[BEARINGS];
    double centre[BEARINGS][2];         // displacement at which a bearing is centred [m]
    double arm;                         // radius of the planet centres [m]
    double gravity;                     // [m/s^2], 0 without weight
    double downwards;                   // its direction from x of the housing [rad]
    std::int64_t turn_numerator[AXES];  // turns of the frame per turn of each motor, as a fraction
    std::int64_t turn_denominator[AXES];
    alignas(64) double line[MESHES][ENTRIES];  // turn of the line of action per displacement [1/m]
    std::int64_t entries;  // of the rows of the meshes; with axial motion and tilts or without
    TiltingAxis tilting[BEARINGS];
    // Slope of the flanks of a mesh against each other along the face, per tilt [1/m], and twelfth
    // of the square of the face width [m^2].
    alignas(64) std::int64_t slope_place[MESHES][SLOPES];
    alignas(64) double slope[MESHES][SLOPES];
    double face_square;
};

}  // namespace gearbox
