#pragma once

// Where a run begins: the train in quasi-static equilibrium at its operating point.
//
// Each flank carries what the mean torque puts on it, the couplings are wound up, and the torques
// are trimmed for the friction of one mesh cycle, so that a run is steady from its first moment but
// for the vibration that the meshes start.

#include "train/balance.hpp"
#include "train/model.hpp"
#include "train/state.hpp"
#include "train/step_constants.hpp"

namespace gearbox {

struct InitialState {
    State state;
    double unbalanced;  // largest force that nothing balances there, friction apart [N]
    std::int64_t body;  // on which it acts
};

// The state in which a run begins, at time zero and motor angle zero.
//
// model: the train at its operating point.
// speed: of the motors (AXES,) [rad/s].
// force: mean force of every mesh [N].
InitialState initial_state(const Model& model, const double* speed, double force);

}  // namespace gearbox
