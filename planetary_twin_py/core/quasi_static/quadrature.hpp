#pragma once

// Integrals of what a quasi-static run adds up, by Gauss' rule on panels between tooth pair events.
//
// Panels lie between the places in the mesh cycle where a tooth pair begins or ends to enter or
// leave, or is at its pitch point. Where friction turns its sense they are halved until the rule on
// both halves agrees with that on the whole.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "quasi_static/equilibrium.hpp"
#include "quasi_static/totals.hpp"
#include "run/clock.hpp"

namespace gearbox {

// What is followed: the train, the error allowed, and room to work in.
struct Follower {
    const Model& model;
    double tolerance;  // see `settle`
    Equilibrium& run;
    double (*shown)[MESHES];  // (QUANTITIES,)
};

// Two times [s].
struct Span {
    double begin;
    double end;
};

// Write the totals (TOTALS,) of a span of time since `origin` that is smooth into `out`; raise
// `peak` to what is seen there.
void integrate(const Follower& follower, const State& origin, Span span, double* out,
               double (*peak)[MESHES]);

// Panels of one mesh cycle.
struct Panels {
    std::vector<double> phase;                              // edges, from 0 to 1
    std::vector<std::array<double, TOTALS>> totals;         // up to them
    std::vector<std::array<double, PEAKS * MESHES>> peaks;  // of the panel before each
};

// Panels of one mesh cycle of steady running from `origin` on.
//
// edges: from 0 to 1, shares of the cycle between which nothing jumps.
// period: of the cycle [s].
//
// Throws std::invalid_argument: the tolerance asks for too many panels.
Panels divide_cycle(const Follower& follower, const State& origin, std::span<const double> edges,
                    double period);

// Move `mark` panel by panel, as long as they end by `until`.
//
// edges: in mesh cycles of the frame, within [0, 1).
// stop: whether to end where all speeds are those wanted.
// integral, peak: which grow along.
void follow(const Follower& follower, State& mark, std::span<const double> edges,
            const Instant& until, bool stop, double* integral, double (*peak)[MESHES]);

}  // namespace gearbox
