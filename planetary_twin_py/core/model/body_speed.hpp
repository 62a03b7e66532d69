#pragma once

// Speed of a body: with the rigid frame, and absolute.

#include "model/state.hpp"
#include "model/train.hpp"

namespace gearbox {

// Speed of body j with the rigid frame [rad/s].
inline double rigid_speed(const Train& train, const State& state, std::int64_t j) {
    return train.body.ratio[0][j] * state.speed[0] + train.body.ratio[1][j] * state.speed[1];
}

// Absolute speed of body j [rad/s].
inline double body_speed(const Train& train, const State& state, const double* v, std::int64_t j) {
    return rigid_speed(train, state, j) + v[j] * train.body.inverse_radius[j];
}

}  // namespace gearbox
