#pragma once

// Events at which flanks come into contact or separate within a step.
//
// The event function of a mesh is the gap that is left until its contact changes: continuous on the
// motion of a step, positive before the event, negative after it. The step ends where it is
// negative by less than the slack; there `accept` changes the contact and adds the lost energy to
// the ledger.

#include <cmath>

#include "integrators/interpolant.hpp"
#include "integrators/propagation.hpp"
#include "mesh/backlash.hpp"
#include "mesh/cycle.hpp"
#include "mesh/form_errors.hpp"

namespace gearbox {

// Share of the tolerance of the elastic deflection: slack of the event functions. The force by
// which flanks pull before they separate is that share of the forces of steady running.
inline constexpr double SLACK = 0.01;
inline constexpr int ROUNDS = 60;  // iterations for the location of an event
inline constexpr double LEAST_OSCILLATION =
    0.5;  // (w h)^2 + c h below which a mode does not oscillate within a step
inline constexpr int SCANNED = 8;  // number of times at which flanks are checked

struct FlankEvent {
    std::int64_t mesh;  // NO_MESH: none
    double when;        // after the start of the step [s]
};

inline double slack_of(const Integrator& integrator) {
    return SLACK * integrator.control.tolerance * integrator.control.elastic_deflection;
}

// `contact_event` of mesh i without errors of form, from its transmission error and the rate.
inline double smooth_gap(const Model& model, const Integrator& integrator, std::int64_t i, double d,
                         double rate) {
    const double tau = integrator.constants.tau[model.train.mesh.kind[i]];
    return remaining_gap(model.train, model.operation.backlash, i, integrator.begin.side[i],
                         {d, tau * rate}, {0.0, 0.0}, slack_of(integrator));
}

// The same at a time within the step.
template <int L>
double smooth_contact_event(const Model& model, Integrator& integrator, std::int64_t i,
                            double delay) {
    const Propagation& run = integrator.run;
    const MatrixRows motion = contacts_of(run).matrices.motion();
    auto [q, p] = modes_at<L>(run.motion, delay);
    double d = 0.0, rate = 0.0;
    for (int m = 0; m < L; ++m) {
        d += motion[m][i] * q[m];
        rate += motion[m][i] * p[m];
    }
    return smooth_gap(model, integrator, i, d, rate);
}

// `contact_event` of mesh i on the interpolant.
inline double contact_event_at(const Model& model, Integrator& integrator, std::int64_t i,
                               double delay) {
    const Train& train = model.train;
    if (integrator.control.collocated && train.errors.lines[train.mesh.kind[i]] == 0)
        return with_lanes(train, [&](auto lanes) {
            return smooth_contact_event<lanes>(model, integrator, i, delay);
        });
    interpolate(model, integrator, delay);
    const double *x = integrator.dense.x, *v = integrator.dense.v;
    double advance = integrator.constants.cycle_rate * delay;
    advance += cycle_shift(train, x) - cycle_shift(train, integrator.begin.x);
    double cycle_rate = integrator.constants.cycle_rate + cycle_shift(train, v);
    return contact_event(model, integrator.begin, integrator.constants, i, x, v,
                         {advance, cycle_rate, slack_of(integrator)});
}

// Whether the step ends at a change of contact of mesh i, to within the slack.
inline bool at_event(const Model& model, Integrator& integrator, std::int64_t i) {
    return std::fabs(contact_event_at(model, integrator, i, integrator.control.step)) <=
           slack_of(integrator);
}

// Mesh whose contact changes first within the step, and the time; if none, NO_MESH and the step.
FlankEvent first_flank_event(const Model& model, Integrator& integrator);

}  // namespace gearbox
