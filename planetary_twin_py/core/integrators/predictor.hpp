#pragma once

// Prediction of the remainder over a step from earlier steps.
//
// The same contacts recur in every mesh cycle. In steady running the remainder changes over a step
// as it did over the same step of the last cycle, so the first sweep is enough. Otherwise it is
// extrapolated from the previous step with the same contacts. Both are initial guesses, which the
// sweeps correct.

#include <cmath>

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SIMILAR = 0.25;  // relative difference of the lengths of two steps compared
inline constexpr int START = MOST_NODES;  // row of the values at the start

// Whether given torques or motions at the ports change within a step.
inline bool given_changes(const Model& model, const State& begin) {
    const std::int64_t* port = model.operation.port;
    if ((port[0] | port[1] | port[2]) == BY_MACHINE) return false;  // no input is given
    bool changes = false;
    for (std::int64_t c = 0; c < model.train.machines; ++c) {
        changes |= model.operation.torque_rate[c] != 0.0;
        if (model.operation.port[c] != BY_MOTION) continue;
        GivenMotion end = given_motion(model, begin, c);
        changes |= end.speed != 0.0 || end.acceleration != 0.0;
    }
    return changes;
}

// Change of the remainder of all modes by given torques until `delay` seconds after the start of
// the step.
template <int L>
Row<L> gain_of_given(const Model& model, const Integrator& integrator, double delay) {
    const Train& train = model.train;
    const ContactState& contacts = contacts_of(integrator.run);
    Row<L> gain(0.0);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        const std::int64_t body = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        const double more =
            model.operation.torque_rate[c] * delay * train.body.inverse_radius[body];
        gain += Row<L>(contacts.matrices.shapes_transposed()[body]) * more;
        if (model.operation.port[c] != BY_MOTION) continue;
        const GivenMotion end = given_motion(model, integrator.begin, c);
        const double coupling_force = train.coupling.stiffness[c] * (end.x(delay) - end.place) +
                                      train.coupling.damping[c] * (end.v(delay) - end.speed);
        gain += Row<L>(contacts.matrices.shapes_transposed()[member]) * coupling_force;
    }
    return gain;
}

// Add this change, times a factor, to a row for each node.
template <int L>
void add_given(const Model& model, const Integrator& integrator, double times,
               double (*remainder)[BODIES]) {
    if (!given_changes(model, integrator.begin)) return;
    const Propagation& run = integrator.run;
    for (int n = 0; n < run.nodes.count; ++n) {
        double delay = run.nodes.abscissa[n] * run.motion.step;
        (Row<L>(remainder[n]) + gain_of_given<L>(model, integrator, delay) * times)
            .store(remainder[n]);
    }
}

// Stored increment of the step with this number since the contacts changed; null: not stored.
inline StoredIncrement* stored_increment(Propagation& run) {
    return run.steps_in_contact_state < STORED_STEPS
               ? &contacts_of(run).increments[run.steps_in_contact_state]
               : nullptr;
}

// Predict remainder and friction from the last step with the same number and contacts; whether it
// is known.
template <int L>
bool repeat_increment(Integrator& integrator) {
    Propagation& run = integrator.run;
    const StoredIncrement* past = stored_increment(run);
    const double step = run.motion.step;
    if (past == nullptr || !(std::fabs(past->step - step) < SIMILAR * step)) return false;
    using V = Row<L>;
    V remainder(past->remainder[START]), friction_force(past->friction_force[START]);
    for (int n = 0; n < run.nodes.count; ++n) {
        (V(run.remainder[n]) + (V(past->remainder[n]) - remainder)).store(run.remainder[n]);
        double* friction = run.node[n].friction_force;
        (V(friction) + (V(past->friction_force[n]) - friction_force)).store(friction);
    }
    return true;
}

// Store remainder and friction of an accepted step, for the next.
template <int L>
void store_step(Propagation& run) {
    PastStep& past = run.past;
    past.step = run.motion.step;
    past.nodes = run.nodes.count;
    for (int n = 0; n < run.nodes.count; ++n) {
        copy<L>(run.remainder[n], past.remainder[n]);
        copy<L>(run.node[n].friction_force, past.friction_force[n]);
    }
}

// Whether the step starts at the end of the last collocation step; then, with the same contacts,
// the remainder is extrapolated.
inline bool continues(const Integrator& integrator) {
    const PastStep& past = integrator.run.past;
    return past.step > 0.0 && past.nodes == integrator.run.nodes.count &&
           past.end_seconds == integrator.begin.seconds && past.end_time == integrator.begin.time;
}

// Extrapolate remainder and friction by the slopes and curvatures of the polynomials of the last
// step at its end: higher powers would amplify the errors that remain after the sweeps.
template <int L>
void extrapolate(Propagation& run) {
    const PastStep& past = run.past;
    const double longer = run.motion.step / past.step;
    for (int n = 0; n < run.nodes.count; ++n) {
        const double s = run.nodes.abscissa[n] * longer;
        Row<L> remainder(run.remainder[n]), friction_force(run.node[n].friction_force);
        for (int i = 0; i < run.nodes.count; ++i) {
            double growth = 0.0;  // of the polynomial that is 1 at node i and 0 at the others
            for (int k = 1; k < run.nodes.count; ++k)
                growth += run.nodes.coefficient[k][i] * (k * s + 0.5 * k * (k - 1) * s * s);
            remainder += growth * Row<L>(past.remainder[i]);
            friction_force += growth * Row<L>(past.friction_force[i]);
        }
        remainder.store(run.remainder[n]);
        friction_force.store(run.node[n].friction_force);
    }
}

// Store the increments of remainder and friction over the step, without those of given torques.
template <int L>
void store_increment(const Model& model, Integrator& integrator) {
    Propagation& run = integrator.run;
    StoredIncrement* const stored = stored_increment(run);
    if (stored == nullptr) return;
    StoredIncrement& past = *stored;
    past.step = run.motion.step;
    using V = Row<L>;
    V remainder = V(run.force) + V(run.damper) * V(run.start.p) + V(run.spring) * V(run.start.q);
    remainder.store(past.remainder[START]);
    copy<L>(run.start.friction_force, past.friction_force[START]);
    for (int n = 0; n < run.nodes.count; ++n) {
        copy<L>(run.remainder[n], past.remainder[n]);
        copy<L>(run.node[n].friction_force, past.friction_force[n]);
    }
    add_given<L>(model, integrator, -1.0, past.remainder);
}

}  // namespace gearbox
