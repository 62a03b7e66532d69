#pragma once

// Stability of periodic motion: a second run starts beside the train's, at speeds that differ by a
// few tolerances. It approaches the motion if that is stable, and leaves it if it is not, however
// slowly the train itself would leave it.

#include "integrators/integrator_record.hpp"

namespace gearbox {

// Start a run beside the train's.
void start_neighbour(const Model& model, Integrator& integrator);

// Advance it by one period; return its difference from the train [tolerances], or infinity if it
// does not complete the period.
double follow_neighbour(const Model& model, Integrator& integrator);

}  // namespace gearbox
