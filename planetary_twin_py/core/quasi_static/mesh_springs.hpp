#pragma once

#include "model/model.hpp"
#include "quasi_static/equilibrium_record.hpp"

namespace gearbox {

// Set stiffness, clearance and error of form of every mesh at its position.
void place_springs(const Model& model, Equilibrium& run);

}  // namespace gearbox
