#pragma once

// Estimated error of the friction loss of a step.
//
// Near the pitch point friction reverses within a small range of sliding speeds. This affects the
// mean loss more than the transmission error.

#include <algorithm>
#include <cmath>

#include "integrators/step_ledger.hpp"

namespace gearbox {

// Length of a step in mesh cycles for which the allowed error of the loss is one tolerance. The
// allowed error of a shorter step is larger, up to MOST_MISSED tolerances, because its weight in
// the mean is smaller.
inline constexpr double PART_OF_CYCLE = 0.05;
inline constexpr double MOST_MISSED = 4.0;

// Error of the quadrature of the friction loss of all meshes at N nodes, in tolerances.
//
// The quadrature is exact for Legendre polynomials up to degree 2 N - 2. The coefficient of degree
// 2 N - 1 is extrapolated from those of the degrees N - 2 and N - 1 by their ratio. Meshes that
// separate within the step do not count: the step will end there.
template <int L>
double loss_error(const Train& train, const Integrator& integrator) {
    using V = Row<L>;
    const Propagation& run = integrator.run;
    const std::int64_t count = run.nodes.count;
    if (!train.friction || count < 2) return 0.0;
    const double (*legendre)[MOST_NODES] = run.nodes.legendre;
    V mean(0.0), below(0.0), highest(0.0), least(run.node[0].meshes.normal_force);
    for (std::int64_t n = 0; n < count; ++n) {
        V power(run.node[n].friction.drag.power);
        mean += legendre[0][n] * power;
        below += legendre[count - 2][n] * power;
        highest += legendre[count - 1][n] * power;
        least = smaller(least, V(run.node[n].meshes.normal_force));
    }
    V missed = absolute(highest), fall = missed / (missed + absolute(below) + SMALLEST);
    for (std::int64_t n = 0; n < count; ++n) missed *= fall;
    missed = select(least > 0.0, missed, 0.0);
    double cycles = run.motion.step * std::fabs(integrator.constants.cycle_rate);
    double tolerances = std::min(PART_OF_CYCLE / (cycles + SMALLEST), MOST_MISSED);
    double allowed =
        tolerances * integrator.control.tolerance * sum_of_meshes<L>(train, absolute(mean));
    return sum_of_meshes<L>(train, missed) / (allowed + SMALLEST);
}

}  // namespace gearbox
