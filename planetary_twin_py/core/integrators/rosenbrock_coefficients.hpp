#pragma once

// Coefficients of ROS34PW2, after the usual transformation that avoids products with the Jacobian
// (Hairer and Wanner, Solving Ordinary Differential Equations II, section IV.7): stages u = Gamma
// k.

#include "integrators/rosenbrock.hpp"

namespace gearbox::ros34pw2 {

inline constexpr double GAMMA = 4.3586652150845900e-01;

using Table = double[STAGES][STAGES];
using Weights = double[STAGES];

inline constexpr Table ALPHA = {
    {0.0, 0.0, 0.0, 0.0},
    {8.7173304301691801e-01, 0.0, 0.0, 0.0},
    {8.4457060015369423e-01, -1.1299064236484185e-01, 0.0, 0.0},
    {0.0, 0.0, 1.0, 0.0},
};
inline constexpr Table GAMMAS = {
    {GAMMA, 0.0, 0.0, 0.0},
    {-8.7173304301691801e-01, GAMMA, 0.0, 0.0},
    {-9.0338057013044082e-01, 5.4180672388095326e-02, GAMMA, 0.0},
    {2.4212380706095346e-01, -1.2232505839045147e00, 5.4526025533510214e-01, GAMMA},
};
inline constexpr Weights B = {2.4212380706095346e-01, -1.2232505839045147e00, 1.5452602553351020e00,
                              GAMMA};
inline constexpr Weights B_EMBEDDED = {3.7810903145819369e-01, -9.6042292212423178e-02, 5.0e-01,
                                       2.1793326075422950e-01};

struct Transformed {
    double a[STAGES][STAGES];     // alpha Gamma^-1
    double c[STAGES][STAGES];     // 1/gamma - Gamma^-1
    double weight[STAGES];        // b Gamma^-1
    double error_weight[STAGES];  // (b - embedded b) Gamma^-1
    double abscissa[STAGES];
    double time_weight[STAGES];
};

consteval Transformed transform() {
    // Inverse of the lower triangle, column by column.
    double inverse[STAGES][STAGES] = {};
    for (int j = 0; j < STAGES; ++j)
        for (int i = j; i < STAGES; ++i) {
            double value = i == j ? 1.0 : 0.0;
            for (int k = j; k < i; ++k) value -= GAMMAS[i][k] * inverse[k][j];
            inverse[i][j] = value / GAMMAS[i][i];
        }
    Transformed out{};
    for (int i = 0; i < STAGES; ++i)
        for (int j = 0; j < STAGES; ++j) {
            for (int k = 0; k < STAGES; ++k) out.a[i][j] += ALPHA[i][k] * inverse[k][j];
            out.c[i][j] = (i == j ? 1.0 / GAMMA : 0.0) - inverse[i][j];
            out.weight[j] += B[i] * inverse[i][j];
            out.error_weight[j] += (B[i] - B_EMBEDDED[i]) * inverse[i][j];
            out.abscissa[i] += ALPHA[i][j];
            out.time_weight[i] += GAMMAS[i][j];
        }
    return out;
}

inline constexpr Transformed STAGE = transform();

}  // namespace gearbox::ros34pw2
