#pragma once

// Small symmetric positive definite systems, solved in place.

#include <cmath>

#include "capacities.hpp"

namespace gearbox {

using Matrix = double (*)[BODIES];  // rows of a square matrix over the bodies

// Cholesky factor of the leading n x n part, in the lower triangle; inverse diagonal.
inline void factorise(Matrix a, std::int64_t n) {
    for (std::int64_t j = 0; j < n; ++j) {
        double pivot = a[j][j];
        for (std::int64_t k = 0; k < j; ++k) pivot -= a[j][k] * a[j][k];
        double inverse = 1.0 / std::sqrt(pivot);
        a[j][j] = inverse;
        for (std::int64_t i = j + 1; i < n; ++i) {
            double value = a[i][j];
            for (std::int64_t k = 0; k < j; ++k) value -= a[i][k] * a[j][k];
            a[i][j] = value * inverse;
        }
    }
}

// Replace b (n,) by the solution, with the factor `a` of `factorise`.
inline void solve(const double (*a)[BODIES], std::int64_t n, double* b) {
    for (std::int64_t i = 0; i < n; ++i) {
        double value = b[i];
        for (std::int64_t k = 0; k < i; ++k) value -= a[i][k] * b[k];
        b[i] = value * a[i][i];
    }
    for (std::int64_t i = n - 1; i >= 0; --i) {
        double value = b[i];
        for (std::int64_t k = i + 1; k < n; ++k) value -= a[k][i] * b[k];
        b[i] = value * a[i][i];
    }
}

}  // namespace gearbox
