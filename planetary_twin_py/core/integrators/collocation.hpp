#pragma once

// One step of exponential collocation.
//
// The rest of `propagation` is taken at Radau's points of the step, answered exactly, and taken
// anew at what comes out, until that moves no more. So a step is as long as the *rest* is smooth,
// however the meshes swing or stiffly settle (exponential Runge-Kutta methods of collocation type:
// Hochbruck and Ostermann 2010, Exponential integrators, Acta Numerica 19, section 2.2).

#include <cmath>
#include <limits>

#include "integrators/predictor.hpp"
#include "integrators/propagation.hpp"
#include "mesh/mesh_forces.hpp"
#include "train/equations.hpp"

namespace gearbox {

inline constexpr int MOST_SWEEPS = 6;
inline constexpr double LEFT_OVER = 0.1;  // of the tolerance that a sweep not made may leave
// Pull of a sweep beyond which a shorter step or another method is called for.
inline constexpr double WEAKEST_PULL = 0.5;
inline constexpr double CLOSE = 0.1;  // of that, below which the next passage is predicted too
inline constexpr double TAIL = 4.0;   // by which the estimated error of the polynomial counts more
inline constexpr double LEAST_DAMPED = 1e-6;  // c h below which errors last for ever
inline constexpr double ASTRAY = std::numeric_limits<double>::infinity();

// What a tried step of collocation has come to.
struct Outcome {
    double error;  // over what is allowed
    bool settled;  // whether the sweeps came to rest
};

// The rest at node n from what the meshes, friction and machines do there.
template <int L>
LAW void find_rest(const Model& model, March& march, const ContactState& contacts, std::int64_t n) {
    using V = Row<L>;
    Propagation& run = march.run;
    Evaluation& out = run.evaluation[n];
    const double *x = run.node_x[n], *v = run.node_v[n];
    const double delay = run.nodes.abscissa[n] * run.motion.step;
    alignas(64) double push[L];
    (V(march.moment.side) * V(out.now.push)).store(push);
    copy<L>(out.rubbing, out.force);
    apply_couplings(model.train, x, v, out);
    apply_machines(model, march.begin, march.moment, x, v, delay, run.node_trim[n], out);
    out.force[model.train.bodies] = 0.0;  // the ground
    V rest = sum_rows<L>(contacts.share, out.force) + sum_rows<L>(contacts.press, push);
    rest += V(run.damper) * V(run.node_p[n]) + V(run.spring) * V(run.node_q[n]);
    rest.store(run.rest[n]);
}

// Take the rest anew at all nodes, with friction as it was unless `with_friction`.
template <int L>
void sweep(const Model& model, March& march, bool with_friction) {
    const State& begin = march.begin;
    const StepConstants& constants = march.moment;
    Propagation& run = march.run;
    const ContactState& contacts = contacts_of(run);
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        Evaluation& out = run.evaluation[n];
        const double *x = run.node_x[n], *v = run.node_v[n];
        copy<L>(run.node_d[n], out.now.d);
        copy<L>(run.node_rate[n], out.now.rate);
        mesh_forces<L>(model, begin, constants, x, v, run.nodes.abscissa[n] * run.motion.step, out);
        if (with_friction) apply_friction(model, begin, constants, v, out);
        find_rest<L>(model, march, contacts, n);
    }
}

// Largest motion of a mesh, or change of the speed of a body, between the last sweep and the one
// before, over its tolerance.
template <int L>
double difference(const Model& model, const March& march) {
    using V = Row<L>;
    const Propagation& run = march.run;
    const std::int64_t last = run.nodes.count - 1;
    alignas(64) double tau[L];  // lanes beyond the meshes stand still
    for (int i = 0; i < L; ++i) tau[i] = march.moment.tau[model.train.kind[i]];
    V d = V(run.node_d[last]) - V(run.before_d), rate = V(run.node_rate[last]) - V(run.before_rate);
    V speed = absolute(V(run.node_v[last]) - V(run.before_v));
    double of_meshes = largest(larger(absolute(d), V(tau) * absolute(rate)));
    double change =
        std::max(of_meshes / march.control.tolerance_x, largest(speed) / march.control.tolerance_v);
    return std::isfinite(total(d + rate)) ? change : ASTRAY;  // a maximum loses what is no number
}

// The local error of the speeds of the bodies, from that of the modes.
template <int L>
double tail_of_speeds(const March& march, const Row<L>& error) {
    using V = Row<L>;
    const double (*form)[BODIES] = contacts_of(march.run).form;
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
    alignas(64) double moved[L];
    (missed / stiff).store(moved);
    double error = largest(sum_rows<L>(contacts_of(run).reach, moved)) / march.control.tolerance_x;
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
        visit_nodes<L>(model, march);
        change = difference<L>(model, march);
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
    double change = ASTRAY, tail = 0.0, pull = known_pull * run.motion.step;
    for (int round = 0; round < MOST_SWEEPS; ++round) {
        double before = change;
        sweep<L>(model, march, true);
        march.control.evaluations += run.nodes.count;
        visit_last_node<L>(model, march);
        change = difference<L>(model, march);
        if (round == 0) {
            tail = tail_error<L>(march);
        } else if (before > 0.0) {
            pull = change / before;
            known_pull = pull / run.motion.step;
        }
        contacts_of(run).predictable = round == 0 && change * pull <= CLOSE * LEFT_OVER;
        if (!(tail <= 1.0) || change * pull <= LEFT_OVER)
            return {std::isfinite(tail + change) ? tail : ASTRAY, true};
        if (round > 0 && !(pull <= WEAKEST_PULL)) break;
        visit_other_nodes<L>(model, march);
    }
    return {ASTRAY, false};
}

// Try a step of h, up to the motion at its nodes; `fresh`: the contacts have just changed.
template <int L>
Outcome collocate(const Model& model, March& march, double h, bool fresh) {
    Propagation& run = march.run;
    set_step<L>(run, h, fresh);
    for (int n = 0; n < run.nodes.count; ++n)
        copy<L>(march.first.rubbing, run.evaluation[n].rubbing);
    const bool recalled = fresh && recall<L>(march);
    visit_nodes<L>(model, march);
    ContactState& contacts = contacts_of(run);
    if (!contacts.varies) return settle_friction<L>(model, march, contacts.pull[1]);
    // What was foreseen needs no sweep of the meshes alone; the others have them along.
    if (recalled && contacts.predictable) return settle_friction<L>(model, march, contacts.pull[0]);
    settle_meshes<L>(model, march);
    double tail = tail_error<L>(march);
    if (!(tail <= 1.0)) return {std::isfinite(tail) ? tail : ASTRAY, true};
    return settle_friction<L>(model, march, contacts.pull[1]);
}

}  // namespace gearbox
