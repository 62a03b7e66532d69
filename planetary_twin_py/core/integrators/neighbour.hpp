#pragma once

// Stability of periodic motion: a second run starts beside the train's, at speeds that differ by a
// few tolerances. It approaches the motion if that is stable, and leaves it if it is not, however
// slowly the train itself would leave it.

#include "integrators/integrator_record.hpp"

namespace gearbox {

// Whether a mesh cycle starts at the end of the step.
inline bool begins_mesh_cycle(const Integrator& integrator) {
    const State &begin = integrator.begin, &end = integrator.end;
    return begin.segment[0] != 0 && end.segment[0] == 0 && end.side[0] != OPEN;
}

// Start a run beside the train's.
void start_neighbour(const Model& model, Integrator& integrator);

// Advance it by one period; return its difference from the train [tolerances], or infinity if it
// does not complete the period.
double follow_neighbour(const Model& model, Integrator& integrator);

}  // namespace gearbox
