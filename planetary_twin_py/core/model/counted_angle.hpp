#pragma once

// Angles that turn with the motors. Whole turns of the motors are counted by exact fractions, so
// the accuracy does not depend on the duration of the run.

#include <numbers>

#include "capacities.hpp"
#include "model/state.hpp"

namespace gearbox {

// Angle [rad] `delay` seconds after a state, from its turns per turn of each motor: as a fraction,
// and rounded.
inline double counted_angle(const State& state, const std::int64_t* numerator,
                            const std::int64_t* denominator, const double* per_motor,
                            double delay) {
    double turns = 0.0, rate = 0.0;
    for (int a = 0; a < AXES; ++a) {
        const std::int64_t period = denominator[a];
        auto whole = static_cast<std::int64_t>(state.turns[a]) % period;
        turns += static_cast<double>(whole * numerator[a] % period) / static_cast<double>(period);
        turns += per_motor[a] * state.fraction[a];
        rate += per_motor[a] * state.speed[a];
    }
    return 2.0 * std::numbers::pi * turns + rate * delay;
}

}  // namespace gearbox
