#pragma once

// Friction and drag in static equilibrium, which are updated from pass to pass.

#include <algorithm>

#include "model/equations.hpp"
#include "quasi_static/equilibrium_record.hpp"

namespace gearbox {

// Update friction and drag from the forces of the meshes in `run.evaluation`; the former ones are
// in `run.before`.
inline void update_friction(const Model& model, Equilibrium& run) {
    Evaluation& evaluation = run.evaluation;
    std::copy_n(evaluation.friction_force, BODIES, run.before);
    std::fill(std::begin(evaluation.power), std::end(evaluation.power), 0.0);
    apply_friction(model, run.state, run.step, run.state.v, evaluation);
}

// Under-relax the friction: zero where its sense has just changed, otherwise the mean of both.
//
// The friction of a light load is large relative to it. So an idle planet would alternate between
// its flanks from pass to pass, although it is at rest within its backlash.
inline void relax_friction(const Train& train, Equilibrium& run) {
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        double &now = run.evaluation.friction_force[j], before = run.before[j];
        now = now * before < 0.0 ? 0.0 : 0.5 * (now + before);
    }
}

}  // namespace gearbox
