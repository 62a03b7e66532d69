#pragma once

#include "quasi_static/equilibrium_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Torques of the machines, and the forces on all bodies but those of the meshes.
void put_external(const Model& model, Equilibrium& run);

// Share the forces among the planets; their mean magnitude [N].
double solve_load_sharing(const Model& model, Equilibrium& run);

// Put every planet where its meshes carry their forces, and an idle one amid its play.
void place_planets(const Model& model, Equilibrium& run);

}  // namespace gearbox
