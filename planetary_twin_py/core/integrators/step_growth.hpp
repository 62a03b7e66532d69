#pragma once

// By how much a step may grow after the error of the last one.

#include "vector/math.hpp"

namespace gearbox {

inline constexpr double SAFETY = 0.8, SHRINK = 0.25, GROW = 2.0;  // of steps
inline constexpr double LARGEST_ERROR = 1e100;                    // in tolerances
// Error below which steps grow by GROW for every order, up to five: (SAFETY/GROW)^5, rounded down.
inline constexpr double HARDLY_ANY_ERROR = 0.01;

// Factor for the next step from the error in tolerances and the order of the error, or GROW if it
// is larger.
inline double growth_of_step(double error, double order) {
    if (error < HARDLY_ANY_ERROR) return GROW;
    if (!(error < LARGEST_ERROR)) return SHRINK;  // also if NaN
    return SAFETY * power(error, -1.0 / order);
}

}  // namespace gearbox
