#pragma once

// The report of a train, and the angles of its bodies after whole turns of the motors, with exact
// fractions of tooth numbers.

#include <cstdint>
#include <numbers>

#include "capacities.hpp"

namespace gearbox {

// The report of a train: every body and mesh of the gearset, in the order of their names.
struct Report {
    std::int64_t bodies;
    std::int64_t body[BODIES];             // its place in the train; the ground is after the last
    std::int64_t numerator[BODIES][AXES];  // turns per whole turn of each motor, as a fraction
    std::int64_t denominator[BODIES];      // of the turns of both
    std::int64_t meshes;
    std::int64_t mesh[MESHES];  // its place in the train
};

constexpr double FULL_TURN = 2.0 * std::numbers::pi;  // [rad]

// Remainder in [0, divisor).
inline std::int64_t wrapped(std::int64_t value, std::int64_t divisor) {
    std::int64_t rest = value % divisor;
    return rest < 0 ? rest + divisor : rest;
}

// Fraction of a turn, in [0, 1), from whole turns of the motors.
inline double part_of_turn(const Report& report, std::int64_t body, const double* turns) {
    std::int64_t denominator = report.denominator[body], parts = 0;
    for (int a = 0; a < AXES; ++a) {
        auto whole = static_cast<std::int64_t>(turns[a]);
        parts += wrapped(whole, denominator) * report.numerator[body][a];  // which cannot overflow
    }
    return static_cast<double>(wrapped(parts, denominator)) / static_cast<double>(denominator);
}

}  // namespace gearbox
