#pragma once

// Sums of the meshes between any two instants, which need not be ends of steps.
//
// Whole steps are those of `step_sums`. Of the first and the last step only a part counts,
// evaluated at equidistant times from dense output by Simpson's rule.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

// Add the part of the last step that has not been counted, before the next step.
void count_step(const Model& model, Integrator& integrator);

// Add the last step up to `delay` seconds after its start.
void count_until(const Model& model, Integrator& integrator, double delay);

}  // namespace gearbox
