#pragma once

// Interpolant of the last step, and samples from it.
//
// A sample depends on the state at the start of its step, on the motion of the step and on its own
// time. It writes to work space only, `dense`, `run.shown` and `work`, so steps do not depend on
// samples, nor samples on each other or on windows.

#include <cstring>

#include "integrators/methods.hpp"
#include "integrators/propagation.hpp"
#include "integrators/trial_step.hpp"
#include "run/samples.hpp"

namespace gearbox {

// x and v within the last step: the result of its method for a step that ends there.
//
// Polynomials through the ends of a Rosenbrock step do not represent fast decay of the flanks
// within it. The states at the ends do not change if the load changes later.
inline void interpolate(const Model& model, Integrator& integrator, double delay) {
    State& dense = integrator.dense;
    if (integrator.control.collocated) {
        with_lanes(model.train, [&](auto lanes) {
            propagate<lanes>(model, integrator, delay, dense.x, dense.v);
        });
        return;
    }
    bool at_begin = delay <= SHORTEST_STEP;
    if (at_begin || delay >= integrator.control.step - SHORTEST_STEP) {
        const State& nearest = at_begin ? integrator.begin : integrator.end;
        std::memcpy(dense.x, nearest.x, sizeof dense.x);
        std::memcpy(dense.v, nearest.v, sizeof dense.v);
        std::memcpy(dense.bristle, nearest.bristle, sizeof dense.bristle);
        return;
    }
    trial_step(model, integrator, delay, dense);
}

// Write samples at `count` times [s] after the start of the last step, within it, at most
// MOST_INSTANTS. One call takes less time than one call per sample, with identical results.
void sample(const Model& model, Integrator& integrator, const double* delays, int count,
            const Samples& out, std::int64_t row);

inline void sample(const Model& model, Integrator& integrator, double delay, const Samples& out,
                   std::int64_t row) {
    sample(model, integrator, &delay, 1, out, row);
}

}  // namespace gearbox
