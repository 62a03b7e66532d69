#pragma once

// A step by the method that is asked for, where collocation is not: for step control and samples.

#include "integrators/march_record.hpp"
#include "integrators/rosenbrock.hpp"
#include "integrators/step_control.hpp"
#include "train/model.hpp"

namespace gearbox {

// Advance `march.begin` by h seconds into `out`, without regard to events.
inline void trial_step(const Model& model, March& march, double h, State& out) {
    switch (march.control.method) {
        default:
            rosenbrock_step(model, march.begin, march.constants, h, march.first, out, march.work);
    }
}

}  // namespace gearbox
