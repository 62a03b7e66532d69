#pragma once

// Samples of a quasi-static run.

#include "quasi_static/equilibrium.hpp"
#include "run/clock.hpp"
#include "run/samples.hpp"

namespace gearbox {

// Write the sample at an instant into a row of `out`; for `run` see `solve_equilibrium`.
void sample(const Model& model, double tolerance, const State& origin, Equilibrium& run,
            const Instant& at, const Samples& out, std::int64_t row);

// Fill all rows of `out`; `origin` is advanced.
void sample_all(const Model& model, double tolerance, State& origin, Equilibrium& run,
                Sampling samples, const Samples& out);

}  // namespace gearbox
