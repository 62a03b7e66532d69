#pragma once

// Integrals and extremes of the quantities of the meshes over the last step.
//
// A collocation step is evaluated at its nodes, like its energy ledger; where its meshes vibrate
// too fast for them, transmission errors and forces are evaluated at equidistant times by Simpson's
// rule. A Rosenbrock step is evaluated at its ends by the trapezoidal rule.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

inline constexpr std::int64_t FEWEST = 4;  // least number of intervals between equidistant times

// Sum up the last step, before contacts change at its end.
void sum_step(const Model& model, Integrator& integrator);

// Number of equal intervals that resolve h seconds of a collocation step, 0: the nodes suffice.
std::int64_t even_intervals(const Integrator& integrator, const Train& train, double h);

// Set times from `begin` to `end` [s] and weights of Simpson's rule; the number of intervals is
// even.
void set_even_times(Series& series, double begin, double end, std::int64_t intervals);

// Integrals and extremes of transmission errors and forces, from the series.
void add_series(const Model& model, Integrator& integrator, MeshSums& step);

}  // namespace gearbox
