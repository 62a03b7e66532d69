#pragma once

// How the rest of the motion grows over a step, from what earlier steps have shown.
//
// Meshing returns to the same contacts in every cycle. In steady running the rest then grows from
// the start of the step as it did the last time, so it needs no further sweep. Within a contact
// state it grows on as it did over the step before. Either is a guess: where it is wrong, the
// sweeps find out.

#include <cmath>

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SIMILAR = 0.25;  // relative difference of the lengths of two steps compared
inline constexpr int START = MOST_NODES;  // row of what was at the start

// Whether what is given at the ports changes within a step.
inline bool given_changes(const Model& model, const State& begin) {
    bool changes = false;
    for (std::int64_t c = 0; c < model.train.machines; ++c) {
        changes |= model.load.torque_rate[c] != 0.0;
        if (model.load.port[c] != BY_MOTION) continue;
        GivenMotion end = given_motion(model, begin, c);
        changes |= end.speed != 0.0 || end.acceleration != 0.0;
    }
    return changes;
}

// What the rest of all modes gains by that until `delay` seconds after the start of the step.
template <int L>
Row<L> gain_of_given(const Model& model, const Integrator& integrator, double delay) {
    const Train& train = model.train;
    const ContactState& contacts = contacts_of(integrator.run);
    Row<L> gain(0.0);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        const std::int64_t body = train.coupling[c][0], member = train.coupling[c][1];
        const double more = model.load.torque_rate[c] * delay * train.inverse_radius[body];
        gain += Row<L>(contacts.matrices.shapes_transposed()[body]) * more;
        if (model.load.port[c] != BY_MOTION) continue;
        const GivenMotion end = given_motion(model, integrator.begin, c);
        const double coupling_force = train.coupling_stiffness[c] * (end.x(delay) - end.place) +
                                      train.coupling_damping[c] * (end.v(delay) - end.speed);
        gain += Row<L>(contacts.matrices.shapes_transposed()[member]) * coupling_force;
    }
    return gain;
}

// Add so many times this gain to a row for each node.
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

// What is kept of the step at this place since the contacts changed; null: nothing ever is.
inline StoredIncrement* stored_increment(Propagation& run) {
    return run.place < STORED_STEPS ? &contacts_of(run).increments[run.place] : nullptr;
}

// Let rest and friction grow over the step as they did when it was last made; whether that is
// known.
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

// Keep the rest and friction of a step that has just been accepted, for the next.
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

// Whether the step begins where the last one by collocation has ended; if so, and if the contacts
// have not changed since, the rest grows on.
inline bool continues(const Integrator& integrator) {
    const PastStep& past = integrator.run.past;
    return past.step > 0.0 && past.nodes == integrator.run.nodes.count &&
           past.end_seconds == integrator.begin.seconds && past.end_time == integrator.begin.time;
}

// Let rest and friction grow on as the polynomials of the last step do at its end, by their slopes
// and curvatures there: higher powers would amplify what the sweeps have left.
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

// Keep how rest and friction grew over the step, but for what was given.
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
