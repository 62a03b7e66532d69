#pragma once

// Integration of the friction of gears that creep, or that vibration brings to rest.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

// Select the friction model of the next step: bristles if the gears creep, else the traction curve.
// The bristles start with the friction of the traction curve, so friction does not jump.
void select_friction_model(const Model& model, Integrator& integrator);

// Use Rosenbrock's method for some steps if vibration may reverse friction: the error of a
// polynomial through friction that changes its sign is larger than its values at the nodes show.
// For creeping gears, such steps are only counted.
void avoid_reversals(const Model& model, Integrator& integrator);

}  // namespace gearbox
