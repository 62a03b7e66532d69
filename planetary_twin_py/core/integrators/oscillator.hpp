#pragma once

// Exact free motion of one mode, q'' + c q' + w^2 q = 0, without branches.

#include <algorithm>
#include <cmath>

#include "vector/math.hpp"

namespace gearbox {

inline constexpr double FREE_MASS = 1e-3;  // (w h)^2 + c h below which a mode counts as a free mass
inline constexpr double NEARLY_CRITICAL = 1e-4;  // smaller phases: series of the sine
inline constexpr double SMALLEST = 1e-300;       // keeps divisions finite

// Whether spring and damper of a mode are negligible for h seconds.
ALWAYS_INLINE bool is_free(double square, double damping, double h) {
    return square * h * h + damping * h < FREE_MASS;
}

struct DecayRates {
    double rate;       // angular frequency, or half the difference of both decay rates [1/s]
    double slow_rate;  // both decay rates, equal if underdamped [1/s]
    double fast_rate;
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

// Free motions after t seconds; for `rate` and `slow` see `decay_rates`. The derivatives of the
// motions are -w^2 times the second, and the first minus c times the second.
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
