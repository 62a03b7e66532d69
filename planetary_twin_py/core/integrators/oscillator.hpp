#pragma once

// Exact free motion of one mode, q'' + c q' + w^2 q = 0, without branches.

#include <algorithm>
#include <cmath>

#include "vector/math.hpp"

namespace gearbox {

inline constexpr double FREE_MASS = 1e-3;        // (w h)^2 + c h below which a mode hardly moves
inline constexpr double NEARLY_CRITICAL = 1e-4;  // phase below which a sine counts as its series
inline constexpr double SMALLEST = 1e-300;       // keeps divisions finite

// Whether a mode hardly moves of its own within h seconds.
ALWAYS_INLINE bool is_free(double square, double damping, double h) {
    return square * h * h + damping * h < FREE_MASS;
}

struct DecayRates {
    double rate;  // angular rate of the wave, or half the gap between two decays [1/s]
    double slow;  // both decays [1/s]
    double fast;
};

ALWAYS_INLINE DecayRates decay_rates(double square, double damping) {
    double half = 0.5 * damping;
    double split = square - half * half;
    double rate = std::sqrt(std::fabs(split));
    bool underdamped = split >= 0.0;
    double slow = square / (underdamped ? 1.0 : half + rate);
    return {rate, underdamped ? half : slow, underdamped ? half : half + rate};
}

struct Wave {
    double cosine;  // motion from (q, q') = (1, 0)
    double sine;    // motion from (0, 1)
};

// Free motions after t seconds. The rates are those of `decay_rates`. Those of the motions are
// -w^2 times the second, and the first less c times the second.
ALWAYS_INLINE Wave wave(double damping, double rate, double slow, double fast, double t) {
    double phase = rate * t;
    double lasting = precise_exp(-slow * t), fading = precise_exp(-fast * t);
    auto [sine, cosine] = sin_cos(phase);
    bool underdamped = slow == fast, apart = phase > NEARLY_CRITICAL;
    double inverse = 1.0 / std::max(rate, SMALLEST);
    double series = t * (1.0 - phase * phase / 6.0);
    double oscillation = lasting * (apart ? sine * inverse : series);
    double gap = 0.5 * (lasting - fading) * inverse;
    double near = fading * t * (1.0 + phase + phase * phase / 1.5);
    double overdamped_part = apart ? gap : near;
    double second = underdamped ? oscillation : overdamped_part;
    double first = underdamped ? lasting * cosine : 0.5 * (lasting + fading);
    return {first + 0.5 * damping * second, second};
}

}  // namespace gearbox
