#pragma once

// What lies within the last step: its interpolant, and samples from it.

#include <cstring>

#include "integrators/propagation.hpp"
#include "integrators/step_control.hpp"
#include "integrators/trial_step.hpp"
#include "run/samples.hpp"

namespace gearbox {

// x and v within the last step, as its method would have them had it ended there.
//
// Polynomials through the ends of a stiff step do not know how flanks settle within it. Its ends
// stand, whatever the load has become since.
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

// Write what the train shows at so many times [s] after the start of the last step, within it, at
// most MOST_INSTANTS. Together they take less time than one by one, and have the same bits.
void sample(const Model& model, Integrator& integrator, const double* delays, int count,
            const Samples& out, std::int64_t row);

inline void sample(const Model& model, Integrator& integrator, double delay, const Samples& out,
                   std::int64_t row) {
    sample(model, integrator, &delay, 1, out, row);
}

}  // namespace gearbox
