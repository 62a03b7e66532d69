#pragma once

// A step of any method but collocation: for step control and samples.

#include "integrators/integrator_record.hpp"
#include "integrators/rosenbrock.hpp"
#include "model/model.hpp"

namespace gearbox {

// Advance `integrator.begin` by h seconds into `out`, regardless of events.
//
// A method reads the state at the start, its constants and `first`, the forces there. It writes x,
// v, trim and shares of friction of `out`, and in `work` the local errors, the energy of the step
// and the displacement of the machines. It leaves sides and segments, which change only in
// `accept`. The same arguments give the same bits, because a sample at h repeats the step.
inline void trial_step(const Model& model, Integrator& integrator, double h, State& out) {
    rosenbrock_step(model, integrator.begin, integrator.constants, h, integrator.first, out,
                    integrator.work);
}

}  // namespace gearbox
