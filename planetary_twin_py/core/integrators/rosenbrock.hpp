#pragma once

// One step of ROS34PW2, a linearly implicit Runge-Kutta method of order 3.
//
// Rang and Angermann 2005, New Rosenbrock W-methods of order 3 for partial differential algebraic
// equations of index 1, BIT 45, 761-787. A W-method: its order does not need the exact Jacobian, so
// the matrix contains meshes, couplings and the derivative of friction with respect to sliding, but
// neither that with respect to the load nor the speed loop. L-stable, as the damping of a mesh at
// low speed requires, and stiffly accurate.
//
// The second-order form halves the linear system: with x' = v, stages need one Cholesky
// factorisation of M/(gamma h) + C + gamma h K per step.

#include "integrators/workspace.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "model/step_constants.hpp"

namespace gearbox {

inline constexpr int STAGES = 4;
inline constexpr int ROSENBROCK_ORDER = 3;

// Advance x, v and trim of `state` by h seconds into `out`.
//
// `first` holds the forces at the start. The increments of the energy ledger and the local errors
// are in `work` afterwards. Sides and segments remain those of `state`.
void rosenbrock_step(const Model& model, const State& state, const StepConstants& constants,
                     double h, Evaluation& first, State& out, Workspace& work);

// Compute the work of the machines from the displacement over the step.
//
// The wind-up of a shaft is much larger than its vibration: the error of the displacement of its
// end, times its whole torque, would be missing in the ledger, although it is equal at both ends of
// the shaft.
void add_machine_work(const Train& train, const State& state, double h, const State& out,
                      Workspace& work);

}  // namespace gearbox
