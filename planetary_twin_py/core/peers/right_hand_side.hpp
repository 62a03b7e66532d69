#pragma once

// The gearbox as one function (t, y) -> dy, which is all that an off-the-shelf solver wants.
//
// Nothing is remembered between two calls: which flanks touch and where every mesh stands in its
// table of tooth pairs follow from t and y by the laws of the train, so the function jumps in its
// derivatives wherever a tooth pair or a flank changes, and its solver has to find that out.
//
// The state y holds x [m] of all bodies less that at the start, in a frame that turns uniformly at
// the speeds the motors start with; then v [m/s] and the integral of each motor's speed error
// [rad], so that nothing drifts and nothing that is much larger than it varies loosens a relative
// tolerance.

#include <cstdint>

#include "run/problem.hpp"

namespace gearbox {

// Number of entries of y.
inline std::int64_t problem_size(const Problem& problem) {
    return 2 * problem.model.train.bodies + problem.model.train.axes;
}

// Fill `state` and `step` with what y is at time t [s].
void place_problem(Problem& problem, double t, const double* y);

// Fill dy/dt at time t [s].
void derivative(Problem& problem, double t, const double* y, double* dy);

// Fill dte (meshes,) with the transmission errors [m] at time t; power loss [W].
double show_problem(Problem& problem, double t, const double* y, double* dte);

}  // namespace gearbox
