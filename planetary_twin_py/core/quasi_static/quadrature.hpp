#pragma once

// Integrals of a quasi-static run by Gauss quadrature on panels between tooth pair events.
//
// Panels end at the places in the mesh cycle where the entry or exit of a tooth pair starts or
// ends, or where a pair is at its pitch point. Where friction reverses they are halved until the
// rule on both halves agrees with that on the whole.

#include <array>
#include <span>
#include <vector>

#include "quasi_static/equilibrium.hpp"
#include "quasi_static/totals.hpp"
#include "run/clock.hpp"

namespace gearbox {

// The train, its allowed error, and work space.
struct EquilibriumSolver {
    const Model& model;
    double tolerance;  // see `solve_equilibrium`
    Equilibrium& run;
    double (*shown)[MESHES];  // (QUANTITIES,)
};

// Two times [s].
struct Span {
    double begin;
    double end;
};

// Write the totals (TOTALS,) of a smooth span of time since `origin` to `out`; update `peak`.
void integrate(const EquilibriumSolver& solver, const State& origin, Span span, double* out,
               double (*peak)[MESHES]);

// Time [s] from `state` to the end of its panel, which may be 0.
double panel_length(const Model& model, const State& state, std::span<const double> edges);

// Panels of one mesh cycle.
struct Panels {
    std::vector<double> phase;                              // edges, from 0 to 1
    std::vector<std::array<double, TOTALS>> totals;         // up to each edge
    std::vector<std::array<double, PEAKS * MESHES>> peaks;  // of the panel before each edge
};

// Panels of one mesh cycle of steady running from `origin` on.
//
// edges: shares of the cycle from 0 to 1 between which all quantities are smooth. period: of the
// cycle [s].
//
// Throws std::invalid_argument if the tolerance requires too many panels.
Panels divide_cycle(const EquilibriumSolver& solver, const State& origin,
                    std::span<const double> edges, double period);

// Advance `state` panel by panel, as long as they end by `until`.
//
// edges: in mesh cycles of the frame, within [0, 1). stop: whether to end where all speeds have
// reached their targets. integral, peak: updated.
void integrate_panels(const EquilibriumSolver& solver, State& state, std::span<const double> edges,
                      const Instant& until, bool stop, double* integral, double (*peak)[MESHES]);

}  // namespace gearbox
