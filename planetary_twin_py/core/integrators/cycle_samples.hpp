#pragma once

// Samples of periodic running, from polynomials.
//
// The samples of a repeated step are those of its first pass. So they are computed once at a few
// points and then interpolated. If the error of interpolation exceeds a hundredth of the tolerance,
// every sample is computed. All samples of repeated steps are from this file, so that they do not
// depend on the division of a run into windows.

#include <span>

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"
#include "run/clock.hpp"
#include "run/samples.hpp"

namespace gearbox {

// Write the sample at an instant within the step that was replayed last, to which the integrator is
// set.
void sample_cycle(const Model& model, Integrator& integrator, const Instant& at, const Samples& out,
                  std::int64_t row);

// Replay steps until one ends at or after `until`, and write the samples that are due by then.
//
// Cycles without a sample of the first grid are summed up as a whole, so the others do not
// change the rounding of the sums.
void replay_window(const Model& model, Integrator& integrator, const Instant& until,
                   std::span<Grid> grids);

}  // namespace gearbox
