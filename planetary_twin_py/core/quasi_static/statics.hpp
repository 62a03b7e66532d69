#pragma once

#include "model/model.hpp"
#include "quasi_static/equilibrium_record.hpp"

namespace gearbox {

// Set stiffness, clearance and error of form of every mesh at its position.
void place_springs(const Model& model, Equilibrium& run);

// Torques of the machines, and all forces on the bodies without those of the meshes.
void put_external(const Model& model, Equilibrium& run);

// Distribute the forces to the planets; their mean magnitude [N].
double solve_load_sharing(const Model& model, Equilibrium& run);

// Place every planet by the forces of its meshes, and an idle one in the middle of its backlash.
void place_planets(const Model& model, Equilibrium& run);

}  // namespace gearbox
