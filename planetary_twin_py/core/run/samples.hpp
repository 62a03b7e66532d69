#pragma once

#include <cstdint>

#include "run/clock.hpp"
#include "run/limits.hpp"

namespace gearbox {

constexpr std::int64_t SAMPLE_DRAGS = 2;  // power lost to bearings and churning
constexpr std::int64_t SAMPLE_AXES = 4;   // displacement, then force on the bearing, two each
// Where axes tilt: axial displacement and two tilts, then axial force and two moments on the
// bearing.
constexpr std::int64_t SAMPLE_TILTING = 6;

// Samples of one window, in arrays of the caller. The position of body j is turns @ ratio[j] turns
// + angle[j]. All pointers but the first may be null: not requested.
struct Samples {
    std::int64_t rows;
    std::int64_t quantities;  // number of the first rows of `observe`
    std::int64_t meshes;
    std::int64_t bodies;
    std::int64_t axes;
    double* mesh;               // (rows, quantities, meshes)
    double* turns;              // (rows, axes) whole turns of the motors
    double* angle;              // (rows, bodies) [rad]
    double* speed;              // (rows, bodies) [rad/s]
    double* drag;               // (rows, SAMPLE_DRAGS) [W]
    Peaks* peaks = nullptr;     // of computed samples, not of repeated ones
    std::int64_t bearings = 0;  // number of the first bearings of the train to be written
    double* moved = nullptr;    // (rows, bearings, SAMPLE_AXES) [m] and [N]
    double* tilting = nullptr;  // (rows, bearings, SAMPLE_TILTING) [m], [rad], [N], [N m]

    double* mesh_row(std::int64_t row) const { return mesh + row * quantities * meshes; }

    // Row `row` of samples with all quantities, as samples of one row.
    Samples only(std::int64_t row) const {
        Samples one = *this;
        one.rows = 1;
        one.mesh = mesh_row(row);
        one.turns += row * axes;
        one.angle += row * bodies;
        one.speed += row * bodies;
        one.drag += row * SAMPLE_DRAGS;
        one.moved += row * bearings * SAMPLE_AXES;
        if (tilting) one.tilting += row * bearings * SAMPLE_TILTING;
        return one;
    }
};

// Samples at equal intervals, which are written as their times are reached.
struct Grid {
    Sampling next;  // the sample that is due next
    Samples out;
    std::int64_t taken = 0;  // its rows that are written

    bool full() const { return taken == out.rows; }
};

}  // namespace gearbox
