#pragma once

// Baselines with a fixed step that is not aligned with events.

#include "problem.hpp"

namespace gearbox {

// A method with a fixed step: integrates y from times[0] on; row k of `samples` is y at times[k +
// 1], `steps` steps after times[k]. There are `count` rows.
using FixedStep = void(Problem& problem, const double* times, std::int64_t steps, double* y,
                       double* samples, std::int64_t count);

// The classical Runge-Kutta method of order 4.
FixedStep runge_kutta_4;

// The semi-implicit Euler method: speeds first, then positions with the new speeds.
FixedStep semi_implicit_euler;

}  // namespace gearbox
