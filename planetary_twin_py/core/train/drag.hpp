#pragma once

// Drag outside the tooth contacts: bearings, seals and grease, and members that churn oil.

#include <cmath>

#include "losses/bearing.hpp"
#include "losses/churning.hpp"
#include "mesh/cycle.hpp"
#include "train/body_speed.hpp"
#include "train/evaluation.hpp"
#include "train/model.hpp"

namespace gearbox {

constexpr double SLOWEST_DRAG_TURN = 1e-2;  // [rad/s] below which the sense of drag fades out
constexpr std::int64_t NO_PLANET = -1;

inline double drag_sense(double speed) {
    return speed / std::sqrt(speed * speed + SLOWEST_DRAG_TURN * SLOWEST_DRAG_TURN);
}

// Load [N] on the pin of a planet, whose two meshes add up or oppose each other.
inline double pin_load(const Train& train, const State& state, const double* push,
                       std::int64_t planet) {
    if (planet == NO_PLANET) return 0.0;
    std::int64_t planets = planets_of(train);
    double sum = 0.0;
    for (std::int64_t i = planet; i < train.meshes; i += planets)
        sum += static_cast<double>(state.side[i]) * push[i];
    return train.pin_share * std::abs(sum);
}

// Add the drag of joints and discs under the pushes of the meshes to `rubbing`; book it in `power`.
inline void apply_drag(const Model& model, const State& state, const double* v, const double* push,
                       double* rubbing, double* power) {
    const Train& train = model.train;
    const Oil& oil = model.oil;
    for (std::int64_t b = 0; b < train.joints; ++b) {
        std::int64_t inner = train.joint_body[b][0], outer = train.joint_body[b][1];
        double speed = body_speed(train, state, v, inner) - body_speed(train, state, v, outer);
        double load = pin_load(train, state, push, train.joint_planet[b]);
        double torque = train.joint_coulomb[b] + train.joint_viscous[b] * std::abs(speed);
        torque +=
            bearing_torque(train.joint_idle[b], train.joint_rubbing[b], oil.kinematic, speed, load);
        torque *= drag_sense(speed) * train.body_copies[inner];
        rubbing[inner] -= torque / train.radius[inner];
        rubbing[outer] += torque / train.radius[outer];
        power[BEARING] += torque * speed;
    }
    for (std::int64_t n = 0; n < train.discs; ++n) {
        std::int64_t body = train.disc_body[n];
        double radius = train.disc_radius[n], speed = body_speed(train, state, v, body);
        double density = train.disc_fill * oil.density;
        double torque = disc_torque(radius, train.disc_gap / radius, density, oil.kinematic, speed);
        torque *= drag_sense(speed);
        rubbing[body] -= torque / train.radius[body];
        power[CHURNING] += torque * speed;
    }
}

}  // namespace gearbox
