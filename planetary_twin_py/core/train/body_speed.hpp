#pragma once

// How fast a body turns: with the rigid frame, and against it.

#include "train/state.hpp"
#include "train/train.hpp"

namespace gearbox {

// Absolute speed of body j [rad/s].
inline double body_speed(const Train& train, const State& state, const double* v, std::int64_t j) {
    double rigid = train.ratio[j][0] * state.speed[0] + train.ratio[j][1] * state.speed[1];
    return rigid + v[j] * train.inverse_radius[j];
}

}  // namespace gearbox
