#pragma once

// The damping time tau of c = tau k, which may follow the rate at which teeth pass.

#include <cmath>
#include <numbers>

#include "capacities.hpp"
#include "model/step_constants.hpp"
#include "model/train.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Mesh cycles per second from the speeds of the motors, unsigned.
inline double passing_rate(const Train& train, const StepConstants& step, const double* v) {
    double rate = step.cycle_rate;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        std::int64_t motor = train.coupling[2 * a][0];
        rate +=
            train.cycles[a] * v[motor] * train.inverse_radius[motor] * (0.5 * std::numbers::inv_pi);
    }
    return std::abs(rate);
}

// tau [s] of a kind of mesh at the rate at which teeth pass [1/s].
inline double damping_time(const Train& train, std::int64_t kind, double rate) {
    return train.damping_time[kind] + train.damping_cycles / at_least(rate, train.lowest_frequency);
}

}  // namespace gearbox
