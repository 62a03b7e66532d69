#pragma once

// Energy stored in the train, which the ledger must balance.

#include "mesh/contact_change.hpp"
#include "model/bearings.hpp"
#include "model/body_speed.hpp"
#include "model/model.hpp"

namespace gearbox {

struct Energies {
    double kinetic, elastic;  // [J]
};

// Kinetic energy of all bodies, machines included [J], without those with given motion.
inline double kinetic(const Model& model, const State& state) {
    const Train& train = model.train;
    double total = 0.0;
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        if (has_given_motion(model, j)) continue;
        double speed = body_speed(train, state, state.v, j) * train.body.radius[j];
        total += 0.5 * train.body.mass[j] * speed * speed;
    }
    if constexpr (MOVING) {
        double turning = rigid_speed(train, state, train.moving.frame);
        total += centrifugal_energy(train, turning, state.x);
        if (!tilts(train)) return total;
        for (std::int64_t b = 0; b < train.moving.bearings; ++b) {
            double spin = rigid_speed(train, state, train.moving.tilting[b].turns);
            total += tilting_energy(train, turning, spin, b, state.x);
        }
    }
    return total;
}

// Elastic energy of meshes in contact, couplings, bearings and bristles, and potential energy of
// weight [J]; `step` is work space.
inline double elastic(const Model& model, const State& state, StepConstants& step) {
    const Train& train = model.train;
    double total = state.presliding;
    for (std::int64_t i = 0; i < train.meshes; ++i) total += stored_energy(model, state, step, i);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        double twist = state.x[train.coupling.ends[c][0]] - state.x[train.coupling.ends[c][1]];
        total += 0.5 * train.coupling.stiffness[c] * twist * twist;
    }
    if constexpr (MOVING) {
        for (std::int64_t b = 0; b < train.moving.bearings; ++b) {
            total += bearing_energy(train, b, state.x);
            if (tilts(train)) total += axial_tilt_energy(train, b, state.x);
        }
        for (std::int64_t k = 0; k < train.moving.pits; ++k)
            total += effect_of_pit(train, state, k, 0.0, state.x).energy;
        total += weight_energy(train, state);
    }
    return total;
}

inline Energies stored(const Model& model, const State& state, StepConstants& step) {
    return {kinetic(model, state), elastic(model, state, step)};
}

}  // namespace gearbox
