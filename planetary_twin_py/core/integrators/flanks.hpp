#pragma once

// Flanks that meet or part within a step, and when.

#include <cmath>
#include <limits>

#include "integrators/interpolant.hpp"
#include "integrators/propagation.hpp"
#include "integrators/step_control.hpp"
#include "mesh/backlash.hpp"
#include "mesh/cycle.hpp"
#include "mesh/form_errors.hpp"

namespace gearbox {

// Share of the local tolerance by which flanks may pull or pass each other.
inline constexpr double SLACK = 0.01;
inline constexpr int ROUNDS = 60;    // of closing in on an event
inline constexpr double TAME = 0.5;  // (w h)^2 + c h below which a mode does not turn round
inline constexpr int SCANNED = 8;    // times at which flanks are looked at

struct FlankEvent {
    std::int64_t mesh;  // NO_MESH: none
    double when;        // after the start of the step [s]
};

inline double slack_of(const March& march) {
    return SLACK * march.control.tolerance_x;
}

// `departure` of mesh i within the step, where no error of form moves its flanks.
template <int L>
double smooth_departure(const Model& model, March& march, std::int64_t i, double delay) {
    const Propagation& run = march.run;
    const MatrixRows motion = contacts_of(run).matrices.motion();
    auto [q, p] = modes_at<L>(run.motion, delay);
    double d = 0.0, rate = 0.0;
    for (int m = 0; m < L; ++m) {
        d += motion[m][i] * q[m];
        rate += motion[m][i] * p[m];
    }
    double tau = march.constants.tau[model.train.kind[i]];
    return play_left(model.train, model.load, i, march.begin.side[i], {d, tau * rate}, {0.0, 0.0},
                     slack_of(march));
}

// `departure` of mesh i on the interpolant.
inline double departure_at(const Model& model, March& march, std::int64_t i, double delay) {
    const Train& train = model.train;
    if (march.control.collocated && train.lines[train.kind[i]] == 0)
        return with_lanes(
            train, [&](auto lanes) { return smooth_departure<lanes>(model, march, i, delay); });
    interpolate(model, march, delay);
    const double *x = march.dense.x, *v = march.dense.v;
    double advance = march.constants.cycle_rate * delay;
    advance += cycle_shift(train, x) - cycle_shift(train, march.begin.x);
    double pace = march.constants.cycle_rate + cycle_shift(train, v);
    return departure(model, march.begin, march.constants, i, x, v,
                     {advance, pace, slack_of(march)});
}

// Whether the step ends where the contact of mesh i changes, to within its slack.
inline bool at_event(const Model& model, March& march, std::int64_t i) {
    return std::fabs(departure_at(model, march, i, march.control.step)) <= slack_of(march);
}

// Mesh whose contact changes first within the step, and when; none: NO_MESH and the step.
FlankEvent first_flank_event(const Model& model, March& march);

}  // namespace gearbox
