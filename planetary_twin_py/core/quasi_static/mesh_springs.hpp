#pragma once

#include "quasi_static/equilibrium_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Set stiffness, clearance and error of form of every mesh at its position.
void place_springs(const Model& model, Equilibrium& run);

}  // namespace gearbox
