#pragma once

#include "quasi_static/equilibrium_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Note stiffness, play and error of form of every mesh where it stands.
void place_springs(const Model& model, Equilibrium& run);

}  // namespace gearbox
