#pragma once

// Gears that creep, or come to rest as they vibrate: how their friction is integrated.

#include "integrators/integrator_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Let tooth pairs hold in the step that begins if the gears creep, and slide if they do not. Pairs
// that begin to hold have the friction of the traction curve, so it does not jump.
void select_friction_model(const Model& model, Integrator& integrator);

// Leave steps to Rosenbrock's method for a while where vibration may reverse friction. A polynomial
// through friction that jumps from one sense to the other is off by more than the change of its
// nodes shows. Vibration of creeping gears is counted only.
void avoid_reversals(const Model& model, Integrator& integrator);

}  // namespace gearbox
