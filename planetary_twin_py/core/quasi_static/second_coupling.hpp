#pragma once

#include "model/state.hpp"
#include "quasi_static/equilibrium.hpp"

namespace gearbox {

// Largest change of the second motor's torque per mesh cycle [N m] at constant `speed` (AXES,),
// with a rigid coupling.
//
// closing_side: side of the teeth that the mean torque loads. origin: position of the motors.
double steepest_torque(const Model& model, double tolerance, std::int64_t closing_side,
                       const State& origin, const double* speed);

}  // namespace gearbox
