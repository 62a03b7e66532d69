#pragma once

// Torques of the machines in static equilibrium: they balance all other forces along the rigid
// motions.

#include <cstdint>
#include <numbers>

#include "model/body_speed.hpp"
#include "model/model.hpp"
#include "quasi_static/equilibrium_record.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Add the inertia of a changing speed, and the torques of the machines, to the forces in
// `run.external`, those of neither meshes nor couplings.
inline void balance_torques(const Model& model, Equilibrium& run) {
    const Train& train = model.train;
    const Operation& operation = model.operation;
    std::int64_t axes = train.axes;
    for (double& balance : run.balance) balance = 0.0;
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double speeding = 0.0;
        for (std::int64_t a = 0; a < axes; ++a)
            speeding += train.body.ratio[a][j] * run.step.slew[a];
        run.external[j] -= train.body.mass[j] * train.body.radius[j] * speeding;
        for (std::int64_t a = 0; a < axes; ++a)
            run.balance[a] += train.body.ratio[a][j] * train.body.radius[j] * run.external[j];
    }
    double torque = operation.torque[MOTOR];
    torque += operation.ripple *
              sin_cos(operation.ripple_order * 2.0 * std::numbers::pi * run.state.fraction[0]).sine;
    for (std::int64_t a = 0; a < axes; ++a) torque += operation.inertia[0][a] * run.step.slew[a];
    run.torque[MOTOR] = torque;
    std::int64_t loaded = train.coupling.ends[LOAD_MACHINE][0];
    run.torque[LOAD_MACHINE] = -(torque + run.balance[0]) / train.body.ratio[0][loaded];
    if (axes > 1) {
        double taken = train.body.ratio[1][loaded] * run.torque[LOAD_MACHINE];
        run.torque[SECOND_MOTOR] = -(taken + run.balance[1]);
    }
    for (std::int64_t c = 0; c < train.machines; ++c)
        run.external[train.coupling.ends[c][0]] +=
            run.torque[c] / train.body.radius[train.coupling.ends[c][0]];
}

// Add the powers of the machines in equilibrium to the ledger.
inline void add_machine_powers(const Model& model, Equilibrium& run) {
    const Train& train = model.train;
    for (std::int64_t c = 0; c < train.machines; ++c) {
        double speed = body_speed(train, run.state, run.state.v, train.coupling.ends[c][0]);
        run.evaluation.power[WORK + c] = run.torque[c] * speed;
        run.evaluation.power[IMPULSE + c] = run.torque[c];
    }
}

}  // namespace gearbox
