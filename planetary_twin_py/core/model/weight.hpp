#pragma once

// Weight of the bodies whose axes move. Gravity has a fixed direction in the housing, so it rotates
// backwards relative to the carrier, whose wind-up relative to the frame may be large.
//
// A planet rises and falls with the carrier by its whole radius. The forces act on the
// displacements as if each body were at its nominal position on the carrier. So the work of the
// weight of a displaced body as the carrier rotates is neither part of the potential energy nor
// supplied by the motors: `add_weight` adds it to the ledger.

#include "capacities.hpp"
#include "model/counted_angle.hpp"
#include "model/state.hpp"
#include "model/train.hpp"
#include "vector/math.hpp"

namespace gearbox {

struct InPlane {
    double along, across;  // x and y, or xi and eta
};

// Angle of the frame [rad] `delay` seconds after a state.
inline double frame_angle(const Train& train, const State& state, double delay) {
    const MovingAxes& axes = train.moving;
    double ratio[AXES];
    for (int a = 0; a < AXES; ++a) ratio[a] = train.body.ratio[a][axes.frame];
    return counted_angle(state, axes.turn_numerator, axes.turn_denominator, ratio, delay);
}

// Gravity [m/s^2] relative to the carrier, from the angle of the frame [rad] and x.
inline InPlane gravity_at(const Train& train, double angle, const double* x) {
    const MovingAxes& axes = train.moving;
    angle += x[train.carrier] * train.body.inverse_radius[train.carrier];
    auto [sine, cosine] = sin_cos(axes.downwards - angle);
    return {axes.gravity * cosine, axes.gravity * sine};
}

// The weight of the body on bearing b [N].
inline InPlane weight_of(const Train& train, std::int64_t b, const InPlane& gravity) {
    const MovingAxes& axes = train.moving;
    const double m = axes.mass[b];
    if (axes.carried[b] == 0.0) return {m * gravity.along, m * gravity.across};
    auto [cosine, sine] = axes.direction[b];
    return {m * (cosine * gravity.along + sine * gravity.across),
            m * (cosine * gravity.across - sine * gravity.along)};
}

// Add the weight of all bodies to `force`, and its power on displaced bodies as the carrier rotates
// to `power`; the frame rotates at `turning` [rad/s].
inline void add_weight(const Train& train, double turning, const InPlane& gravity, const double* x,
                       const double* v, double* force, double& power) {
    const MovingAxes& axes = train.moving;
    const double rate = turning + v[train.carrier] * train.body.inverse_radius[train.carrier];
    for (std::int64_t b = 0; b < axes.bearings; ++b) {
        const std::int64_t along = axes.place[b][0], across = axes.place[b][1];
        const InPlane weight = weight_of(train, b, gravity);
        force[along] += weight.along;
        force[across] += weight.across;
        double beside = x[across] - axes.carried[b] * x[train.carrier];
        power += rate * (weight.along * beside - weight.across * x[along]);
    }
}

// Potential energy of the weight [J].
inline double weight_energy(const Train& train, const State& state) {
    const MovingAxes& axes = train.moving;
    if (axes.gravity == 0.0) return 0.0;
    const double* x = state.x;
    const InPlane gravity = gravity_at(train, frame_angle(train, state, 0.0), x);
    double total = 0.0;
    for (std::int64_t b = 0; b < axes.bearings; ++b) {
        const InPlane weight = weight_of(train, b, gravity);
        const double arm = axes.carried[b] == 0.0 ? 0.0 : axes.arm;
        double beside = x[axes.place[b][1]] - axes.carried[b] * x[train.carrier];
        total -= weight.along * (arm + x[axes.place[b][0]]) + weight.across * beside;
    }
    return total;
}

}  // namespace gearbox
