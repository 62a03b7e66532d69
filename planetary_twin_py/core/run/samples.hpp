#pragma once

#include <cstdint>

namespace gearbox {

constexpr std::int64_t SAMPLE_DRAGS = 2;  // power that bearings and churning take

// Samples of one window, in arrays that their owner keeps. Body j stands at turns @ ratio[j] turns
// + angle[j].
struct Samples {
    std::int64_t rows;
    std::int64_t quantities;  // see `observe`
    std::int64_t meshes;
    std::int64_t bodies;
    std::int64_t axes;
    double* mesh;   // (rows, quantities, meshes)
    double* turns;  // (rows, axes) whole turns of the motors
    double* angle;  // (rows, bodies) [rad]
    double* speed;  // (rows, bodies) [rad/s]
    double* drag;   // (rows, SAMPLE_DRAGS) [W]

    double* mesh_row(std::int64_t row) const { return mesh + row * quantities * meshes; }
};

}  // namespace gearbox
