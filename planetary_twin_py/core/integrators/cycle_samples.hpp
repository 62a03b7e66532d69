#pragma once

// Samples of steady running that repeats, from polynomials.
//
// A repeated step shows what it showed the first time, so what it shows is computed once, at a few
// places, and interpolated from then on. Where that would be less accurate than a hundredth of the
// tolerance, every sample is computed. All samples of a repeated step come from here, so that they
// do not depend on how a run is divided into windows.

#include "integrators/integrator_record.hpp"
#include "run/clock.hpp"
#include "run/samples.hpp"
#include "train/model.hpp"

namespace gearbox {

// Write the sample at an instant within the step that was played last; the march stands on it.
void sample_cycle(const Model& model, Integrator& integrator, const Instant& at, const Samples& out,
                  std::int64_t row);

// Play on to the step that ends at or after `until`, and write the samples that are due by then.
//
// The next of `samples` goes to the row `taken`; both are moved on.
void replay_window(const Model& model, Integrator& integrator, const Instant& until,
                   Sampling& samples, const Samples& out, std::int64_t& taken);

}  // namespace gearbox
