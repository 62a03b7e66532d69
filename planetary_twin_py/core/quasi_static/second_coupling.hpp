#pragma once

#include "quasi_static/equilibrium.hpp"
#include "train/state.hpp"

namespace gearbox {

// Largest change of the second motor's torque per mesh cycle [N m] at constant `speed` (AXES,), its
// coupling being rigid.
//
// lean: side of the teeth on which the mean torque presses.
// origin: where the motors are.
double steepest_torque(const Model& model, double tolerance, std::int64_t closing_side,
                       const State& origin, const double* speed);

}  // namespace gearbox
