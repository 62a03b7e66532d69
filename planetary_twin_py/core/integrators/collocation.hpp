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
inline constexpr double LEFT_OVER = 0.3;  // of the tolerance that a sweep not made may leave
// Pull of a sweep beyond which a shorter step or another method is called for.
inline constexpr double WEAKEST_PULL = 0.5;
inline constexpr double TAIL = 4.0;  // by which the estimated error of the polynomial counts more
inline constexpr double LEAST_DAMPED = 1e-6;  // c h below which errors last for ever
inline constexpr double ASTRAY = std::numeric_limits<double>::infinity();

// What a tried step of collocation has come to.
struct Outcome {
    double error;  // over what is allowed
    bool settled;  // whether the sweeps came to rest
};

// Take the rest anew at all nodes, with friction as it was unless `with_friction`.
template <int L>
void sweep(const Model& model, March& march, bool with_friction) {
    const State& begin = march.begin;
    const StepConstants& constants = march.moment;
    Propagation& run = march.run;
    const ContactState& contacts = contacts_of(run);
    for (int n = 0; n < run.nodes.count; ++n) {
        Evaluation& out = run.evaluation[n];
        const double *x = run.node_x[n], *v = run.node_v[n];
        double delay = run.nodes.abscissa[n] * run.motion.step;
        copy<L>(run.node_d[n], out.now.d);
        copy<L>(run.node_rate[n], out.now.rate);
        mesh_forces(model, begin, constants, x, v, delay, out);
        if (with_friction) apply_friction(model, begin, constants, v, out);
        assemble_forces(model, begin, constants, x, v, delay, run.node_trim[n], out);
        double rest[L];
        sum_rows<L>(contacts.share, out.force, rest);
        for (int m = 0; m < L; ++m) {
            double own = run.damper[m] * run.node_p[n][m] + run.spring[m] * run.node_q[n][m];
            run.rest[n][m] = rest[m] + own;
        }
    }
}

// Largest motion of a mesh, or change of the speed of a body, between the last sweep and the one
// before, over its tolerance.
template <int L>
double difference(const Model& model, const March& march) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    const std::int64_t last = run.nodes.count - 1;
    double of_meshes = 0.0, of_bodies = 0.0, total = 0.0;  // NaN would get lost in a maximum
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double d = run.node_d[last][i] - run.before_d[i];
        double rate = run.node_rate[last][i] - run.before_rate[i];
        double reach = march.moment.tau[train.kind[i]] * std::fabs(rate);
        of_meshes = std::max(of_meshes, std::max(std::fabs(d), reach));
        total += d + rate;
    }
    for (int j = 0; j < L; ++j)
        of_bodies = std::max(of_bodies, std::fabs(run.node_v[last][j] - run.before_v[j]));
    double largest = std::max(of_meshes / march.control.tolerance_x,
                              of_bodies / march.control.tolerance_v);
    return std::isfinite(total) ? largest : ASTRAY;
}

// The local error of the speeds of the bodies, from that of the modes in `now_p`.
template <int L>
double tail_of_speeds(const March& march) {
    const double(*form)[BODIES] = march.run.known.states[march.run.motion.modes].form;
    double speed[L] = {}, largest = 0.0;
    for (int m = 0; m < L; ++m)
        for (int j = 0; j < L; ++j) speed[j] += std::fabs(form[m][j]) * march.run.now_p[m];
    for (int j = 0; j < L; ++j) largest = std::max(largest, speed[j]);
    return largest / march.control.tolerance_v;
}

// Local error, what the highest power of the polynomial moves, over its tolerance.
template <int L>
double tail_error(const Model& model, March& march) {
    Propagation& run = march.run;
    const ModalMotion& motion = run.motion;
    const double h = motion.step, share = TAIL * run.nodes.smallest;
    const std::int64_t highest = run.nodes.count - 1;
    // It moves a mode by such a part of that at rest.
    const double settling = 2.0 * static_cast<double>((highest + 2) * (highest + 3)) / (h * h);
    for (int m = 0; m < L; ++m) {
        double tail = std::fabs(power(run, highest, m));
        double below = std::fabs(power(run, highest - 1, m));
        double at_rest = 1.0 / std::max(motion.square[m], settling);
        // Steps within the memory of a mode make errors that add up at random.
        double lasting = std::sqrt(1.0 + 2.0 / (run.damper[m] * h + LEAST_DAMPED));
        lasting = run.spring[m] == 0.0 ? 1.0 : lasting;
        double missed = tail * tail / (tail + below + SMALLEST) * share * lasting;
        double brief = 1.0 / std::max(1.0 / std::sqrt(at_rest), run.damper[m]);
        run.now_q[m] = missed * at_rest;
        run.now_p[m] = missed * brief;
    }
    double reached[L], largest = 0.0;
    sum_rows<L>(contacts_of(run).reach, run.now_q, reached);
    for (std::int64_t i = 0; i < model.train.meshes; ++i) largest = std::max(largest, reached[i]);
    double error = largest / march.control.tolerance_x;
    return march.control.slow ? std::max(error, tail_of_speeds<L>(march)) : error;
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

// Sweep until what the next one would change is a share of the tolerance.
template <int L>
Outcome settle_friction(const Model& model, March& march) {
    Propagation& run = march.run;
    double& known_pull = contacts_of(run).pull[1];
    double change = ASTRAY, tail = 0.0, pull = known_pull * run.motion.step;
    for (int round = 0; round < MOST_SWEEPS; ++round) {
        double before = change;
        sweep<L>(model, march, true);
        march.control.evaluations += run.nodes.count;
        visit_nodes<L>(model, march);
        change = difference<L>(model, march);
        if (round == 0) {
            tail = tail_error<L>(model, march);
        } else if (before > 0.0) {
            pull = change / before;
            known_pull = pull / run.motion.step;
        }
        if (!(tail <= 1.0) || change * pull <= LEFT_OVER)
            return {std::isfinite(tail + change) ? tail : ASTRAY, true};
        if (round > 0 && !(pull <= WEAKEST_PULL)) break;
    }
    return {ASTRAY, false};
}

// Try a step of h, up to the motion at its nodes; `fresh`: the contacts have just changed.
template <int L>
Outcome collocate(const Model& model, March& march, double h, bool fresh) {
    Propagation& run = march.run;
    set_step<L>(run, h);
    for (int n = 0; n < run.nodes.count; ++n)
        copy<L>(march.first.rubbing, run.evaluation[n].rubbing);
    if (fresh) recall<L>(march);
    visit_nodes<L>(model, march);
    if (contacts_of(run).varies) {
        settle_meshes<L>(model, march);
        double tail = tail_error<L>(model, march);
        if (!(tail <= 1.0)) return {std::isfinite(tail) ? tail : ASTRAY, true};
    }
    return settle_friction<L>(model, march);
}

}  // namespace gearbox
