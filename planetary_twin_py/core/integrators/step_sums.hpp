#pragma once

// Integrals and extremes of what the meshes show, over the last step.
//
// A step by collocation is read at its nodes, as its energy ledger is; where its meshes vibrate too
// fast for them, transmission errors and forces are read at even times, by Simpson's rule. A step
// by Rosenbrock's method is read at its ends, by trapezoids.

#include "integrators/integrator_record.hpp"
#include "train/model.hpp"

namespace gearbox {

inline constexpr std::int64_t FEWEST = 4;  // intervals between even times

// Sum up the step just made, before contacts change at its end.
void sum_step(const Model& model, Integrator& integrator);

// Even intervals that resolve h seconds of a step by collocation, 0: as many nodes do.
std::int64_t even_intervals(const Integrator& integrator, const Train& train, double h);

// Set times from `begin` to `end` [s] and weights of Simpson's rule; intervals are even.
void set_even_times(Series& series, double begin, double end, std::int64_t intervals);

// Integrals and extremes of transmission errors and forces, from the series.
void add_series(const Train& train, const StepConstants& constants, const Series& series,
                MeshSums& step);

}  // namespace gearbox
