#pragma once

// Length and end of a collocation step. It ends exactly on the edge of a tooth pair, or where
// flanks come into contact or separate, because its motion is known at any time within it.

#include "integrators/edges.hpp"
#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

// End the collocation step after h seconds, without computing it again.
void end_within(const Model& model, Integrator& integrator, double h);

// Make a collocation step of at most `longest` seconds, which may end on the edge that the mesh of
// `event` reaches. Return the mesh whose contact changes at the end, NO_MESH, or FAILED.
std::int64_t collocated_step(const Model& model, Integrator& integrator, double longest,
                             const NextEvent& event);

}  // namespace gearbox
