#pragma once

// Damage over the last step: at its nodes, or at equidistant times where its meshes vibrate too
// fast for them or the step ends before its last node; of a Rosenbrock step at its end.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

// Count the damage of the last step, after its other sums and before contacts change at its end.
void count_damage(const Model& model, Integrator& integrator);

// Give the part from `begin` to `end` [s] of a step its share: passages end at the start of a step,
// and extremes are those of the whole step.
void share_damage(const MeshSums& step, double begin, double end, MeshSums& part);

}  // namespace gearbox
