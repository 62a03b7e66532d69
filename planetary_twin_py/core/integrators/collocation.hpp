#pragma once

// One step of exponential collocation.
//
// The rest of `propagation` is evaluated at Radau's points of the step; the exact response to it
// moves the points, and the rest is evaluated again, until the points no longer move. So the *rest*
// limits the length of a step, however fast the meshes vibrate or decay (exponential Runge-Kutta
// methods of collocation type: Hochbruck and Ostermann 2010, Exponential integrators, Acta Numerica
// 19, section 2.2).

#include <cmath>
#include <limits>

#include "integrators/loss_error.hpp"
#include "integrators/mixing.hpp"
#include "integrators/node_forces.hpp"
#include "integrators/predictor.hpp"
#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr int MOST_SWEEPS = 6;
// Of the tolerance that a sweep not made may leave. With 0.2, mesh cycles of some planar runs would
// differ by more than what counts as a repetition.
inline constexpr double LEFT_OVER = 0.1;
// Pull of a sweep beyond which a shorter step or another method is called for.
inline constexpr double WEAKEST_PULL = 0.5;
inline constexpr double WEAKEST_MIXED_PULL = 1.5;  // the same of sweeps that are mixed
// Least pull per step length [1/s] that is assumed: an earlier step may have succeeded by chance.
inline constexpr double LEAST_PULL = 2e3;
inline constexpr double CLOSE = 0.1;  // of that, below which the next passage is predicted too
// By how much the estimated error of the polynomial counts more. With 2, mesh cycles of some runs
// whose axes are held would differ by more than what counts as a repetition.
inline constexpr double TAIL = MOVING ? 2.0 : 4.0;
inline constexpr double LEAST_DAMPED = 1e-6;  // c h below which errors last for ever
inline constexpr double ASTRAY = std::numeric_limits<double>::infinity();

// What a tried step of collocation has come to.
struct Outcome {
    double error;  // over what is allowed
    bool settled;  // whether the sweeps came to rest
};

// Express the start of a step in the modes of its contacts, and what acts there: friction is still
// that of the end of the last step.
template <int L>
void enter(const Model& model, March& march) {
    using V = Row<L>;
    Propagation& run = march.run;
    ModalMotion& motion = run.motion;
    Node& start = run.start;
    motion.modes = find_modes(model, march.begin, run.known);
    ContactState& contacts = contacts_of(run);
    damp_modes<L>(contacts, march.constants.tau);
    copy<L>(contacts.square, motion.square);
    copy<L>(contacts.damping, motion.damping);
    copy<L>(contacts.rate, motion.rate);
    copy<L>(contacts.slow, motion.slow);
    copy<L>(contacts.fast, motion.fast);
    copy<L>(march.begin.x, start.x);
    copy<L>(march.begin.v, start.v);
    for (int a = 0; a < AXES; ++a) start.trim[a] = march.begin.trim[a];
    V mass(model.train.mass);
    RowPair<L> modes =
        sum_rows<L>(contacts.matrices.share(), RowPair<L>{mass * V(start.x), mass * V(start.v)});
    RowPair<MESH_LANES<L>> meshes = sum_rows<MESH_LANES<L>>(contacts.matrices.motion(), modes);
    modes.first.store(start.q);
    modes.second.store(start.p);
    meshes.first.store(start.d);
    meshes.second.store(start.rate);
    sum_rows<L>(contacts.matrices.share(), V(march.last.rubbing)).store(start.rubbing);
    find_forces_at_node<L>(model, march, start, 0.0);
    node_force<L>(model, march, contacts, 0.0, start).store(run.force);
}

// Evaluate the rest at node n.
template <int L>
LAW void find_rest(const Model& model, March& march, const ContactState& contacts, std::int64_t n) {
    using V = Row<L>;
    Propagation& run = march.run;
    Node& node = run.node[n];
    const double delay = run.nodes.abscissa[n] * run.motion.step;
    V rest = node_force<L>(model, march, contacts, delay, node);
    rest += V(run.damper) * V(node.p) + V(run.spring) * V(node.q);
    rest.store(run.rest[n]);
}

// Evaluate the rest at all nodes, with the friction of the last sweep unless `with_friction`.
template <int L>
void sweep(const Model& model, March& march, bool with_friction) {
    Propagation& run = march.run;
    const ContactState& contacts = contacts_of(run);
    for (std::int64_t n = 0; n < run.nodes.count; ++n)
        find_forces_at_node<L>(model, march, run.node[n], run.nodes.abscissa[n] * run.motion.step);
    if (with_friction) find_friction_of_nodes<L>(model, march);
    for (std::int64_t n = 0; n < run.nodes.count; ++n) find_rest<L>(model, march, contacts, n);
}

// Largest motion of a mesh, or change of the speed of a body, between the last sweep and the one
// before, over its tolerance.
template <int L>
double difference(const March& march) {
    using V = Row<MESH_LANES<L>>;
    const Propagation& run = march.run;
    const Node& node = run.node[run.nodes.count - 1];
    V d = V(node.d) - V(run.before_d), rate = V(node.rate) - V(run.before_rate);
    Row<L> speed = absolute(Row<L>(node.v) - Row<L>(run.before_v));
    double of_meshes = largest(larger(absolute(d), V(march.constants.damping) * absolute(rate)));
    double change =
        std::max(of_meshes / march.control.tolerance_x, largest(speed) / march.control.tolerance_v);
    return std::isfinite(total(d + rate)) ? change : ASTRAY;  // a maximum loses what is no number
}

// The local error of the speeds of the bodies, from that of the modes.
template <int L>
double tail_of_speeds(const March& march, const Row<L>& error) {
    using V = Row<L>;
    const MatrixRows form = contacts_of(march.run).matrices.form();
    V speed(0.0);
    for (int m = 0; m < L; ++m) speed += absolute(V(form[m])) * error[m];
    return largest(speed) / march.control.tolerance_v;
}

// Local error, what the highest power of the polynomial moves, over its tolerance.
template <int L>
double tail_error(March& march) {
    using V = Row<L>;
    Propagation& run = march.run;
    const double h = run.motion.step, share = TAIL * run.nodes.smallest;
    const std::int64_t highest = run.nodes.count - 1;
    // It moves a mode by such a part of that at rest.
    const double settling = 2.0 * static_cast<double>((highest + 2) * (highest + 3)) / (h * h);
    V tail = absolute(power<L>(run, highest)), below = absolute(power<L>(run, highest - 1));
    V stiff = larger(V(run.motion.square), V(settling)), damper(run.damper);
    // Steps within the memory of a mode make errors that add up at random.
    V lasting = square_root(1.0 + 2.0 / (damper * h + LEAST_DAMPED));
    lasting = select(V(run.spring) == 0.0, 1.0, lasting);
    V missed = tail * tail / (tail + below + SMALLEST) * share * lasting;
    double error =
        largest(sum_rows<MESH_LANES<L>>(contacts_of(run).matrices.reach(), missed / stiff)) /
        march.control.tolerance_x;
    if (!march.control.slow) return error;
    return std::max(error, tail_of_speeds<L>(march, missed / larger(square_root(stiff), damper)));
}

// Sweep with friction as it is: where stiffness changes fast, this saves evaluating it.
template <int L>
void settle_meshes(const Model& model, March& march) {
    Propagation& run = march.run;
    double& known_pull = contacts_of(run).pull[0];
    double change = ASTRAY, pull = known_pull * run.motion.step;
    for (int round = 0; round < MOST_SWEEPS; ++round) {
        double before = change;
        sweep<L>(model, march, false);
        visit_last_node<L>(model, march);
        visit_other_nodes<L>(model, march);
        change = difference<L>(march);
        if (round > 0 && before > 0.0) {
            pull = change / before;
            known_pull = pull / run.motion.step;
        }
        if (change * pull <= LEFT_OVER) return;
    }
}

// Sweep until what the next one would change is a share of the tolerance; `known_pull` is by how
// much less that is, per step length.
template <int L>
Outcome settle_friction(const Model& model, March& march, double& known_pull) {
    Propagation& run = march.run;
    double change = ASTRAY, tail = 0.0;
    double pull = std::max(known_pull, LEAST_PULL) * run.motion.step;
    Mixing<L> mixing;
    for (int round = 0; round < MOST_SWEEPS; ++round) {
        double before = change;
        if constexpr (MOVING) mixing.keep(run);
        sweep<L>(model, march, true);
        if constexpr (MOVING) mixing.mix(run);
        march.control.evaluations += run.nodes.count;
        visit_last_node<L>(model, march);
        change = difference<L>(march);
        if (round == 0) {
            tail = std::max(tail_error<L>(march), loss_error<MESH_LANES<L>>(model.train, march));
        } else if (before > 0.0) {
            pull = change / before;
            if (!MOVING || round == 1)
                known_pull = (MOVING ? std::max(pull, mixing.pull()) : pull) / run.motion.step;
        }
        if (KeptGrowth* kept = growth_here(run))
            kept->predictable = round == 0 && change * pull <= CLOSE * LEFT_OVER;
        if (!(tail <= 1.0) || change * pull <= LEFT_OVER)
            return {std::isfinite(tail + change) ? tail : ASTRAY, true};
        if (round > 0 && !(pull <= (MOVING ? WEAKEST_MIXED_PULL : WEAKEST_PULL))) break;
        visit_other_nodes<L>(model, march);
    }
    return {ASTRAY, false};
}

// Try a step of h, up to the motion at its nodes; `fresh`: the contacts have just changed.
template <int L>
Outcome collocate(const Model& model, March& march, double h, bool fresh) {
    Propagation& run = march.run;
    set_step<L>(run, h);
    const bool recalled = repeat_growth<L>(march);
    if (!recalled && !fresh && continues(march))
        extrapolate<L>(run);
    else
        add_given<L>(model, march, 1.0, run.rest);
    visit_nodes<L>(model, march);
    ContactState& contacts = contacts_of(run);
    if (!contacts.varies) return settle_friction<L>(model, march, contacts.pull[1]);
    // What was foreseen needs no sweep of the meshes alone; the others have them along.
    if (recalled && growth_here(run)->predictable)
        return settle_friction<L>(model, march, contacts.pull[0]);
    settle_meshes<L>(model, march);
    double tail = tail_error<L>(march);
    if (!(tail <= 1.0)) return {std::isfinite(tail) ? tail : ASTRAY, true};
    return settle_friction<L>(model, march, contacts.pull[1]);
}

}  // namespace gearbox
