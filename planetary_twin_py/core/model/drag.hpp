#pragma once

// Drag outside the tooth contacts: bearings, seals and grease, and churning of oil by members.

#include <cmath>

#include "lubrication/bearing_friction.hpp"
#include "lubrication/churning.hpp"
#include "lubrication/tooth_friction.hpp"
#include "mesh/cycle.hpp"
#include "model/body_speed.hpp"
#include "model/model.hpp"

namespace gearbox {

constexpr double SLOWEST_DRAG_TURN = 1e-2;  // [rad/s] below which drag decreases to zero
constexpr std::int64_t NO_PLANET = -1;

inline bool has_drag(const Train& train) {
    return train.joints.count + train.discs.count > 0;
}

inline double drag_sense(double speed) {
    return speed / std::sqrt(speed * speed + SLOWEST_DRAG_TURN * SLOWEST_DRAG_TURN);
}

// Load [N] on the pin of a planet, from its two meshes.
inline double pin_load(const Train& train, const State& state, const double* normal_force,
                       std::int64_t planet) {
    if (planet == NO_PLANET) return 0.0;
    std::int64_t planets = planets_of(train);
    double sum = 0.0;
    for (std::int64_t i = planet; i < train.meshes; i += planets)
        sum += static_cast<double>(state.side[i]) * normal_force[i];
    return train.joints.pin_share * std::abs(sum);
}

// Magnitude [N m] of the drag of the seals and the grease of joint b.
inline double seal_drag(const Train& train, std::int64_t b, double speed) {
    return train.joints.coulomb[b] + train.joints.viscous[b] * std::abs(speed);
}

// Magnitude [N m] of the drag of joint b at a speed [rad/s] above SLOWEST_DRAG_TURN.
inline double joint_drag(const Model& model, const State& state, const double* normal_force,
                         std::int64_t b, double speed) {
    const Train& train = model.train;
    double load = pin_load(train, state, normal_force, train.joints.planet[b]);
    double torque = seal_drag(train, b, speed);
    torque += bearing_torque(train.joints.no_load_factor[b], train.joints.load_factor[b],
                             model.oil.kinematic, speed, load);
    return torque * train.body.copies[train.joints.body[b][0]];
}

// Add the damping of the drag of joints to `matrix`.
//
// The motion of a light member within SLOWEST_DRAG_TURN decays in nanoseconds. As in
// `friction_damping`, the slope is that of the chord to rest where `force` would reverse the
// rotation within h seconds.
inline void drag_damping(const Model& model, const State& state, const double* normal_force,
                         const double* force, double h, Matrix matrix) {
    const Train& train = model.train;
    for (std::int64_t b = 0; b < train.joints.count; ++b) {
        const std::int64_t* body = train.joints.body[b];
        double speed =
            body_speed(train, state, state.v, body[0]) - body_speed(train, state, state.v, body[1]);
        double row[2] = {train.body.inverse_radius[body[0]], -train.body.inverse_radius[body[1]]};
        double gain = h * (row[0] * force[body[0]] / train.body.mass[body[0]] +
                           row[1] * force[body[1]] / train.body.mass[body[1]]);
        double square = speed * speed + SLOWEST_DRAG_TURN * SLOWEST_DRAG_TURN;
        double chord = joint_drag(model, state, normal_force, b, speed) / std::sqrt(square);
        double tangent = chord * SLOWEST_DRAG_TURN * SLOWEST_DRAG_TURN / square;
        double slope = speed * (speed + gain) < 0.0 ? chord : tangent;
        add_outer(matrix, body, row, 2, slope);
    }
}

// Add the drag of joints and discs under the forces of the meshes to `friction_force`, and its
// power to `power`.
inline void apply_drag(const Model& model, const State& state, const double* v,
                       const double* normal_force, double* friction_force, double* power) {
    const Train& train = model.train;
    const Oil& oil = model.oil;
    for (std::int64_t b = 0; b < train.joints.count; ++b) {
        std::int64_t inner = train.joints.body[b][0], outer = train.joints.body[b][1];
        double speed = body_speed(train, state, v, inner) - body_speed(train, state, v, outer);
        double sense = drag_sense(speed);
        double torque = joint_drag(model, state, normal_force, b, speed) * sense;
        double of_seals = seal_drag(train, b, speed) * train.body.copies[inner] * sense * speed;
        friction_force[inner] -= torque / train.body.radius[inner];
        friction_force[outer] += torque / train.body.radius[outer];
        power[BEARING] += torque * speed;
        power[HEAT + HEAT_SEALS] += of_seals;
        power[HEAT + HEAT_BEARINGS] += torque * speed - of_seals;
    }
    for (std::int64_t n = 0; n < train.discs.count; ++n) {
        std::int64_t body = train.discs.body[n];
        double radius = train.discs.radius[n], speed = body_speed(train, state, v, body);
        double density = train.discs.fill * oil.density;
        double torque =
            disc_torque(radius, train.discs.gap / radius, density, oil.kinematic, speed);
        torque *= drag_sense(speed);
        friction_force[body] -= torque / train.body.radius[body];
        power[CHURNING] += torque * speed;
        power[HEAT + HEAT_CHURNING] += torque * speed;
    }
}

}  // namespace gearbox
