#pragma once

// What the meshes show between any two instants, which need not be ends of steps.
//
// Whole steps count as `step_sums` has them. Of the first and the last only a part counts: it is
// read at even times from dense output, by Simpson's rule.

#include "integrators/integrator_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Let the last step count as far as it has not been taken: another follows.
void count_step(const Model& model, Integrator& integrator);

// Let the last step count up to `delay` seconds after its start.
void count_until(const Model& model, Integrator& integrator, double delay);

}  // namespace gearbox
