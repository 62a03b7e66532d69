#pragma once

// Angle of a body after whole turns of the motors, with exact fractions of tooth numbers.

#include <numbers>

#include "run/report.hpp"

namespace gearbox {

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
