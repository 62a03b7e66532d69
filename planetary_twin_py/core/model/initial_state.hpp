#pragma once

// Start of a run: the train in quasi-static equilibrium at its operating point.
//
// Each flank carries its load by the mean torque, the couplings are wound up, and the torques are
// trimmed for the friction of one mesh cycle. So a run is steady from the start, except for the
// vibration that the meshes excite.

#include "model/model.hpp"
#include "model/state.hpp"

namespace gearbox {

struct InitialState {
    State state;
    double unbalanced;  // largest unbalanced force, without friction [N]
    std::int64_t body;  // on which it acts
};

// The state at the start of a run, at time zero and motor angle zero.
//
// model: the train at its operating point.
// speed: of the motors (AXES,) [rad/s].
// force: mean force of every mesh [N].
InitialState initial_state(const Model& model, const double* speed, double force);

}  // namespace gearbox
