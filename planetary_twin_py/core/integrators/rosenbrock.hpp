#pragma once

// One step of ROS34PW2, a linearly implicit Runge-Kutta method of order 3.
//
// Rang and Angermann 2005, New Rosenbrock W-methods of order 3 for partial differential algebraic
// equations of index 1, BIT 45, 761-787. A W-method: its order does not need the exact Jacobian, so
// the matrix holds meshes, couplings and the growth of friction with sliding, but neither the
// change of friction with the load nor the speed loop.
// L-stable, which the damping of a mesh at low speed asks for, and stiffly accurate.
//
// The second-order form halves the linear system: with x' = v, stages need one Cholesky
// factorisation of M/(gamma h) + C + gamma h K per step.

#include "integrators/workspace.hpp"
#include "train/model.hpp"
#include "train/state.hpp"
#include "train/step_constants.hpp"

namespace gearbox {

inline constexpr int STAGES = 4;
inline constexpr int ROSENBROCK_ORDER = 3;

// Advance x, v and trim of `state` by h seconds into `out`.
//
// `first` holds the forces at the start. The growth of the energy ledger and the local errors are
// left in `work`. Sides and segments stay those of `state`.
void rosenbrock_step(const Model& model, const State& state, const StepConstants& constants,
                     double h, Evaluation& first, State& out, Workspace& work);

// Let the machines do their work over the way that the step makes.
//
// A shaft is wound up by far more than it swings: what its end is wrong by, times all of its
// torque, would be missing in the ledger, though both ends of the shaft agree on it.
void add_machine_work(const Train& train, const State& state, double h, const State& out,
                      Workspace& work);

}  // namespace gearbox
