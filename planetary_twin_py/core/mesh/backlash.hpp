#pragma once

// When flanks come into contact and separate.
//
// A mesh is in contact on its drive side, on its coast side, or open. Flanks never pull. Contact
// ends where the force falls below zero; with damping, the flanks are still squeezed there. Contact
// starts where both deflection and force are positive, with a jump of the force by its damping.
// (Dead zone of Al-shyyab and Kahraman 2007.)

#include "mesh/damping.hpp"
#include "mesh/deflection.hpp"
#include "model/model.hpp"
#include "model/step_constants.hpp"
#include "vector/rows.hpp"

namespace gearbox {

struct MeshPosition {
    double advance, cycle_rate, slack;  // mesh cycles since the start of the step, [1/s], [m]
};

struct LengthAndDamping {
    double length, damping;  // a length and tau times its rate [m]
};

// Gap [m] left to mesh i on `side`, from its deflection and the increase of its backlash; see
// `contact_event`.
inline double remaining_gap(const Train& train, const Backlash& backlash, std::int64_t i,
                            std::int64_t side, LengthAndDamping motion, LengthAndDamping wider,
                            double slack) {
    double d = motion.length, half = backlash.half;
    double normal_force = d + backlash.release * motion.damping;
    if (side != OPEN) return static_cast<double>(side) * normal_force - half + slack;
    double gap = wider.length, slower = wider.length + backlash.release * wider.damping;
    double drive = at_most(d - gap, normal_force - slower),
           coast = at_most(-d - gap, -normal_force - slower);
    if constexpr (MOVING) return slack - (only_side(train, i) == DRIVE_SIDE ? drive : coast) + half;
    return slack - at_least(drive, coast) + half;
}

// The same for all meshes without errors of form, from their transmission errors and the rates; if
// axes do not move, all meshes are closed.
template <int L>
ALWAYS_INLINE Row<L> remaining_gaps(const Train& train, const Backlash& backlash,
                                    const StepConstants& step, const Row<L>& motion,
                                    const Row<L>& rate) {
    using V = Row<L>;
    V side(step.side);
    if constexpr (MOVING)
        side = select(first_of_row<L>(train.meshes / FLANKS), V(1.0), -1.0);  // drive flanks first
    V d = side * motion;
    V normal_force = d + backlash.release * V(step.damping_time) * (side * rate);
    V closed = normal_force - backlash.half;
    if constexpr (!MOVING) return closed;
    return select(V(step.side) == 0.0, backlash.half - smaller(d, normal_force), closed);
}

// The same from the transmission error d of mesh i and its rate, with errors of form; tau is the
// damping time.
NOINLINE inline double remaining_gap(const Model& model, const StepConstants& step, std::int64_t i,
                                     std::int64_t side, double d, double rate, double tau,
                                     MeshPosition position) {
    const Train& train = model.train;
    auto [advance, cycle_rate, slack] = position;
    LengthAndRate error{0.0, 0.0}, wider{0.0, 0.0};
    if (train.errors.lines[train.mesh.kind[i]] > 0) {
        error = form_error(train, i, step.side[i], step.line_angle, advance, cycle_rate);
        if (side == OPEN) wider = radial_error(train, i, step.line_angle, advance, cycle_rate);
    }
    return remaining_gap(train, model.operation.backlash, i, side,
                         {d - error.length, tau * (rate - error.rate)},
                         {wider.length, tau * wider.rate}, slack);
}

// Gap [m] that mesh i has left before its contact changes; negative: it has changed.
//
// Contact ends where d - b + tau d', which is F/k, falls below zero, and begins where that and
// d - b are positive, on either side. Both have a tolerance, `slack`: without load, flanks touch
// without force, and contact would end and start endlessly. (With a regulatory factor the force
// has no effect.) Radial errors of form increase the backlash of an open mesh on both sides.
inline double contact_event(const Model& model, const State& state, const StepConstants& step,
                            std::int64_t i, const double* x, const double* v,
                            MeshPosition position) {
    const Train& train = model.train;
    double d = mesh_motion(train, i, x), rate = mesh_motion(train, i, v);
    double tau = damping_time(train, train.mesh.kind[i], passing_rate(train, step, v));
    return remaining_gap(model, step, i, state.side[i], d, rate, tau, position);
}

}  // namespace gearbox
