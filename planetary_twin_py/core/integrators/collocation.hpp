#pragma once

// One step of exponential collocation.
//
// The nonlinear remainder of `propagation.hpp` is evaluated at the Radau points of the step. The
// exact response to it gives the motion at these points, at which the remainder is evaluated again,
// until this fixed-point iteration converges. Each iteration is called a sweep. So the remainder
// limits the length of a step, not the frequencies and decay rates of the meshes (exponential
// Runge-Kutta methods of collocation type: Hochbruck and Ostermann 2010, Exponential integrators,
// Acta Numerica 19, section 2.2).

#include <cmath>
#include <limits>

#include "integrators/loss_error.hpp"
#include "integrators/mixing.hpp"
#include "integrators/node_forces.hpp"
#include "integrators/predictor.hpp"
#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr int MOST_SWEEPS = 6;
// Share of the tolerance that the last sweep may leave. With 0.2, mesh cycles of some planar runs
// would differ by more than periodicity allows.
inline constexpr double REMAINING_SHARE = 0.1;
// Contraction factor of a sweep above which a shorter step or another method is used.
inline constexpr double LARGEST_CONTRACTION = 0.5;
inline constexpr double LARGEST_MIXED_CONTRACTION = 1.5;  // the same for mixed sweeps
// Smallest contraction factor per step length [1/s] that is assumed: an earlier step may have
// converged by chance.
inline constexpr double LEAST_CONTRACTION = 2e3;
inline constexpr double CLOSE = 0.1;  // share of it that also predicts the next cycle
// Safety factor of the estimated error of the polynomial. With 2, mesh cycles of some runs with
// fixed axes would differ by more than periodicity allows.
inline constexpr double TAIL = MOVING ? 2.0 : 4.0;
inline constexpr double LEAST_DAMPED = 1e-6;  // c h below which errors do not decay
inline constexpr double DIVERGED = std::numeric_limits<double>::infinity();

// Result of a trial step of collocation.
struct Outcome {
    double error;    // in tolerances
    bool converged;  // whether the sweeps converged
};

// Transform the state and the forces at the start of a step to the modes of its contact state.
// Friction is that at the end of the last step.
template <int L>
void enter(const Model& model, Integrator& integrator) {
    using V = Row<L>;
    Propagation& run = integrator.run;
    ModalMotion& motion = run.motion;
    Node& start = run.start;
    motion.contact_state = find_modes(model, integrator.begin, run.known);
    ContactState& contacts = contacts_of(run);
    damp_modes<L>(contacts, integrator.constants.tau);
    motion.fastest_rate = contacts.fastest_rate;
    copy<L>(contacts.square, motion.square);
    copy<L>(contacts.damping, motion.damping);
    copy<L>(contacts.rate, motion.rate);
    copy<L>(contacts.slow_rate, motion.slow_rate);
    copy<L>(contacts.fast_rate, motion.fast_rate);
    copy<L>(integrator.begin.x, start.x);
    copy<L>(integrator.begin.v, start.v);
    for (int a = 0; a < AXES; ++a) start.trim[a] = integrator.begin.trim[a];
    V mass(model.train.body.mass);
    RowPair<L> modes = sum_rows<L>(contacts.matrices.shapes_transposed(),
                                   RowPair<L>{mass * V(start.x), mass * V(start.v)});
    RowPair<MESH_LANES<L>> meshes = sum_rows<MESH_LANES<L>>(contacts.matrices.motion(), modes);
    modes.first.store(start.q);
    modes.second.store(start.p);
    meshes.first.store(start.d);
    meshes.second.store(start.rate);
    sum_rows<L>(contacts.matrices.shapes_transposed(), V(integrator.last.friction_force))
        .store(start.friction_force);
    find_forces_at_node<L>(model, integrator, start, 0.0);
    node_force<L>(model, integrator, contacts, 0.0, start).store(run.force);
}

// Evaluate the remainder at node n.
template <int L>
ALWAYS_INLINE void find_remainder(const Model& model, Integrator& integrator,
                                  const ContactState& contacts, std::int64_t n) {
    using V = Row<L>;
    Propagation& run = integrator.run;
    Node& node = run.node[n];
    const double delay = run.nodes.abscissa[n] * run.motion.step;
    V remainder = node_force<L>(model, integrator, contacts, delay, node);
    remainder += V(run.damper) * V(node.p) + V(run.spring) * V(node.q);
    remainder.store(run.remainder[n]);
}

// Evaluate the remainder at all nodes; unless `with_friction`, with the friction of the last sweep.
template <int L>
void sweep(const Model& model, Integrator& integrator, bool with_friction) {
    Propagation& run = integrator.run;
    const ContactState& contacts = contacts_of(run);
    for (std::int64_t n = 0; n < run.nodes.count; ++n)
        find_forces_at_node<L>(model, integrator, run.node[n],
                               run.nodes.abscissa[n] * run.motion.step);
    if (with_friction) find_friction_of_nodes<L>(model, integrator);
    for (std::int64_t n = 0; n < run.nodes.count; ++n)
        find_remainder<L>(model, integrator, contacts, n);
}

// Largest change of a transmission error or of the speed of a body between the last two sweeps, in
// tolerances.
template <int L>
double difference(const Integrator& integrator) {
    using V = Row<MESH_LANES<L>>;
    const Propagation& run = integrator.run;
    const Node& node = run.node[run.nodes.count - 1];
    V d = V(node.d) - V(run.before_d), rate = V(node.rate) - V(run.before_rate);
    Row<L> speed = absolute(Row<L>(node.v) - Row<L>(run.before_v));
    double of_meshes =
        largest(larger(absolute(d), V(integrator.constants.damping_time) * absolute(rate)));
    double change = std::max(of_meshes / integrator.control.tolerance_x,
                             largest(speed) / integrator.control.tolerance_v);
    V sum = d + rate;  // a maximum may lose NaN
    return none(!(sum - sum == 0.0)) ? change : DIVERGED;
}

// Returns the speed error of the bodies in multiples of the tolerance, from the modal errors.
template <int L>
double tail_of_speeds(const Integrator& integrator, const Row<L>& error) {
    using V = Row<L>;
    const MatrixRows form = contacts_of(integrator.run).matrices.shapes();
    V speed(0.0);
    for (int m = 0; m < L; ++m) speed += absolute(V(form[m])) * error[m];
    return largest(speed) / integrator.control.tolerance_v;
}

// Local error in tolerances: the motion due to the highest power of the polynomial.
template <int L>
double tail_error(Integrator& integrator) {
    using V = Row<L>;
    Propagation& run = integrator.run;
    const double h = run.motion.step, share = TAIL * run.nodes.smallest;
    const std::int64_t highest = run.nodes.count - 1;
    // Dynamic stiffness of a mode for that power [1/s^2].
    const double settling = 2.0 * static_cast<double>((highest + 2) * (highest + 3)) / (h * h);
    V tail = absolute(power<L>(run, highest)), below = absolute(power<L>(run, highest - 1));
    V stiff = larger(V(run.motion.square), V(settling)), damper(run.damper);
    // Errors of steps that are shorter than the decay time of a mode add up at random.
    V lasting = square_root(1.0 + 2.0 / (damper * h + LEAST_DAMPED));
    lasting = select(V(run.spring) == 0.0, 1.0, lasting);
    V missed = tail * tail / (tail + below + SMALLEST) * share * lasting;
    double error = largest(sum_rows<MESH_LANES<L>>(contacts_of(run).matrices.motion_magnitude(),
                                                   missed / stiff)) /
                   integrator.control.tolerance_x;
    if (!integrator.control.friction_limits_speed) return error;
    V fastest = larger(V(contacts_of(run).natural), V(std::sqrt(settling)));
    return std::max(error, tail_of_speeds<L>(integrator, missed / larger(fastest, damper)));
}

// Sweep with unchanged friction: if the stiffness changes fast, this saves evaluations of friction.
template <int L>
void settle_meshes(const Model& model, Integrator& integrator) {
    Propagation& run = integrator.run;
    double& known_contraction = contacts_of(run).contraction[0];
    double change = DIVERGED, contraction = known_contraction * run.motion.step;
    for (int round = 0; round < MOST_SWEEPS; ++round) {
        double before = change;
        sweep<L>(model, integrator, false);
        update_last_node<L>(model, integrator);
        update_other_nodes<L>(model, integrator);
        change = difference<L>(integrator);
        if (round > 0 && before > 0.0) {
            contraction = change / before;
            known_contraction = contraction / run.motion.step;
        }
        if (change * contraction <= REMAINING_SHARE) return;
    }
}

// Sweep until the next sweep would change less than a share of the tolerance. `known_contraction`
// is the contraction factor of a sweep per step length [1/s].
template <int L>
Outcome settle_friction(const Model& model, Integrator& integrator, double& known_contraction) {
    Propagation& run = integrator.run;
    double change = DIVERGED, tail = 0.0;
    double contraction = std::max(known_contraction, LEAST_CONTRACTION) * run.motion.step;
    Mixing<L> mixing;
    for (int round = 0; round < MOST_SWEEPS; ++round) {
        double before = change;
        if constexpr (MOVING) mixing.keep(run);
        sweep<L>(model, integrator, true);
        if constexpr (MOVING) mixing.mix(run);
        integrator.control.evaluations += run.nodes.count;
        update_last_node<L>(model, integrator);
        change = difference<L>(integrator);
        if (round == 0) {
            tail = std::max(tail_error<L>(integrator),
                            loss_error<MESH_LANES<L>>(model.train, integrator));
        } else if (before > 0.0) {
            contraction = change / before;
            if (!MOVING || round == 1)
                known_contraction =
                    (MOVING ? std::max(contraction, mixing.contraction()) : contraction) /
                    run.motion.step;
        }
        if (StoredIncrement* increment = stored_increment(run))
            increment->predictable = round == 0 && change * contraction <= CLOSE * REMAINING_SHARE;
        if (!(tail <= 1.0) || change * contraction <= REMAINING_SHARE)
            return {std::isfinite(tail + change) ? tail : DIVERGED, true};
        if (round > 0 &&
            !(contraction <= (MOVING ? LARGEST_MIXED_CONTRACTION : LARGEST_CONTRACTION)))
            break;
        update_other_nodes<L>(model, integrator);
    }
    return {DIVERGED, false};
}

// Compute a trial step of h seconds, up to the motion at its nodes; `fresh`: the contact state has
// just changed.
template <int L>
Outcome collocate(const Model& model, Integrator& integrator, double h, bool fresh) {
    Propagation& run = integrator.run;
    set_step<L>(run, h);
    const bool recalled = repeat_increment<L>(integrator);
    if (!recalled && !fresh && continues(integrator))
        extrapolate<L>(run);
    else
        add_given<L>(model, integrator, 1.0, run.remainder);
    update_nodes<L>(model, integrator);
    ContactState& contacts = contacts_of(run);
    if (!contacts.varies) return settle_friction<L>(model, integrator, contacts.contraction[1]);
    // A predicted step needs no sweeps without friction.
    if (recalled && stored_increment(run)->predictable)
        return settle_friction<L>(model, integrator, contacts.contraction[0]);
    settle_meshes<L>(model, integrator);
    double tail = tail_error<L>(integrator);
    if (!(tail <= 1.0)) return {std::isfinite(tail) ? tail : DIVERGED, true};
    return settle_friction<L>(model, integrator, contacts.contraction[1]);
}

}  // namespace gearbox
