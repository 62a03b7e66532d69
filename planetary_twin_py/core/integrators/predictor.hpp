#pragma once

// What the last passage through a contact state says of the next.
//
// Meshing returns to the same contacts in every cycle. In steady running the rest of the motion
// then grows from the start of the step as it did the last time, so it needs no further sweep. It
// is a guess: where it is wrong, the sweeps find out.

#include <cmath>

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SIMILAR = 0.25;  // relative difference of the lengths of two steps compared
inline constexpr int START = MOST_NODES;  // row of what was at the start

// Let rest and friction grow over the step as they did when it was last made; whether that is
// known.
template <int L>
bool recall(March& march) {
    Propagation& run = march.run;
    const ContactState& past = contacts_of(run);
    if (!(std::fabs(past.past_step - run.motion.step) < SIMILAR * run.motion.step)) return false;
    using V = Row<L>;
    V rest(past.past_rest[START]), rubbing(past.past_rubbing[START]);
    for (int n = 0; n < run.nodes.count; ++n) {
        (V(run.rest[n]) + (V(past.past_rest[n]) - rest)).store(run.rest[n]);
        double* friction = run.node[n].rubbing;
        (V(friction) + (V(past.past_rubbing[n]) - rubbing)).store(friction);
    }
    return true;
}

// Keep how rest and friction grew over the first step in a contact state.
template <int L>
void remember(March& march) {
    Propagation& run = march.run;
    ContactState& past = contacts_of(run);
    past.past_step = run.motion.step;
    using V = Row<L>;
    V rest = V(run.force) + V(run.damper) * V(run.start.p) + V(run.spring) * V(run.start.q);
    rest.store(past.past_rest[START]);
    copy<L>(run.start.rubbing, past.past_rubbing[START]);
    for (int n = 0; n < run.nodes.count; ++n) {
        copy<L>(run.rest[n], past.past_rest[n]);
        copy<L>(run.node[n].rubbing, past.past_rubbing[n]);
    }
}

}  // namespace gearbox
