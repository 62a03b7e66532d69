#pragma once

// The gearbox as a function (t, y) -> dy, for off-the-shelf solvers.
//
// Nothing is stored between two calls: contacts of flanks and positions of the meshes in their
// tables of tooth pairs follow from t and y by the laws of the train. So the derivatives of the
// function jump wherever the contact of a tooth pair or a flank changes, which its solver has to
// detect.
//
// The state y holds x [m] of all bodies less that at the start, in a frame that turns uniformly at
// the speeds the motors start with; then v [m/s] and the integral of each motor's speed error
// [rad], so that no entry drifts, or is much larger than its variation, which would loosen a
// relative tolerance.

#include <cstdint>

#include "problem.hpp"

namespace gearbox {

// Number of entries of y.
inline std::int64_t problem_size(const Problem& problem) {
    return 2 * problem.model.train.bodies + problem.model.train.axes;
}

// Fill `state` and `step` from y at time t [s].
void place_problem(Problem& problem, double t, const double* y);

// Fill dy/dt at time t [s].
void derivative(Problem& problem, double t, const double* y, double* dy);

// Fill dte (meshes,) with the transmission errors [m] at time t; power loss [W].
double show_problem(Problem& problem, double t, const double* y, double* dte);

}  // namespace gearbox
