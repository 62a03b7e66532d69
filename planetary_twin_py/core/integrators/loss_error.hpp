#pragma once

// Error of the friction of a step, estimated at its nodes.
//
// Beside the pitch point friction reverses within a thin layer of sliding speeds. The transmission
// error may hardly feel it where the mean loss does.

#include <algorithm>
#include <cmath>

#include "integrators/step_ledger.hpp"

namespace gearbox {

// Part of a mesh cycle over which a step may miss one tolerance of the friction. A step that is
// shorter may miss more, as it weighs less in the mean, up to so many tolerances.
inline constexpr double PART_OF_CYCLE = 0.05;
inline constexpr double MOST_MISSED = 4.0;

// What quadrature at N nodes may miss of the friction of all meshes, over its tolerance.
//
// It is exact for Legendre's polynomials up to degree 2 N - 2. The coefficient of the next one
// follows from those of the degrees N - 1 and N - 2 if they fall on as they do there. Flanks that
// part within the step do not count: it will end where they do.
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
