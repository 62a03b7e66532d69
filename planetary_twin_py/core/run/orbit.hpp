#pragma once

// Displacements of axes relative to the housing.

#include "capacities.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Turn displacements (x and y each) of sun, ring and carrier by the angle of the carrier [rad].
inline void turn_to_housing(double angle, const double* const displaced[MEMBERS], double* out) {
    auto [sine, cosine] = sin_cos(angle);
    for (int m = 0; m < MEMBERS; ++m) {
        const double x = displaced[m][0], y = displaced[m][1];
        out[2 * m] = cosine * x - sine * y;
        out[2 * m + 1] = sine * x + cosine * y;
    }
}

}  // namespace gearbox
