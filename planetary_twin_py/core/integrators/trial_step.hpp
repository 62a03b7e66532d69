#pragma once

// A step of the requested method other than collocation: for step control and samples.

#include "integrators/integrator_record.hpp"
#include "integrators/rosenbrock.hpp"
#include "integrators/step_control.hpp"
#include "train/model.hpp"

namespace gearbox {

// Advance `integrator.begin` by h seconds into `out`, regardless of events.
inline void trial_step(const Model& model, Integrator& integrator, double h, State& out) {
    switch (integrator.control.method) {
        default:
            rosenbrock_step(model, integrator.begin, integrator.constants, h, integrator.first, out,
                            integrator.work);
    }
}

}  // namespace gearbox
