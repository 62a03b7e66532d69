#pragma once

// The damping time tau of c = tau k, which may follow the rate at which teeth pass.

#include <cmath>
#include <numbers>

#include "model/step_constants.hpp"
#include "model/train.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Mesh cycles per second from the speeds of the motors, unsigned.
inline double passing_rate(const Train& train, const StepConstants& step, const double* v) {
    double rate = step.cycle_rate;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        std::int64_t motor = train.coupling.ends[2 * a][0];
        rate += train.cycle.per_turn[a] * v[motor] * train.body.inverse_radius[motor] *
                (0.5 * std::numbers::inv_pi);
    }
    return std::abs(rate);
}

// tau [s] of a kind of mesh at the rate at which teeth pass [1/s].
inline double damping_time(const Train& train, std::int64_t kind, double rate) {
    return train.damping.time[kind] +
           train.damping.cycles / at_least(rate, train.damping.lowest_frequency);
}

}  // namespace gearbox
