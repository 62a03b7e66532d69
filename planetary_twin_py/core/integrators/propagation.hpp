#pragma once

// A step whose meshes move exactly, under a polynomial for all that is not linear.
//
// M x'' = F(t, x, v) reads q'' + c q' + w^2 q = rest in the modes of the meshes in contact. The
// rest is friction, machines, errors of form, damping out of proportion, stiffness that changes
// within its segment; a polynomial through its values at the nodes of the step is answered exactly,
// at the nodes and at any time between them: by a polynomial and a free wave. A mode that hardly
// moves of its own within the step counts as a free mass, its spring and damper as part of the rest.

#include <algorithm>
#include <cmath>

#include "integrators/contact_modes.hpp"
#include "integrators/lanes.hpp"
#include "integrators/march_record.hpp"
#include "integrators/oscillator.hpp"
#include "train/model.hpp"

namespace gearbox {

inline constexpr double LONGEST_MEMORY = 1e3;  // c/(w^2 h) of a mode whose motion keeps ten digits

inline ContactState& contacts_of(Propagation& run) { return run.known.states[run.motion.modes]; }

// Express the start of a step in the modes of its contacts.
template <int L>
void enter(const Model& model, March& march) {
    const Train& train = model.train;
    const State& begin = march.begin;
    Propagation& run = march.run;
    ModalMotion& motion = run.motion;
    motion.modes = find_modes(train, begin, run.known);
    const ContactState& contacts = contacts_of(run);
    const double* tau = march.moment.tau;
    for (int m = 0; m < L; ++m) {
        double damping = contacts.shaft_damping[m] + tau[0] * contacts.mesh_damping[0][m];
        damping += tau[1] * contacts.mesh_damping[1][m];
        motion.square[m] = contacts.square[m];
        motion.damping[m] = damping;
        DecayRates rates = decay_rates(contacts.square[m], damping);
        motion.rate[m] = rates.rate;
        motion.slow[m] = rates.slow;
        motion.fast[m] = rates.fast;
        run.now_q[m] = train.mass[m] * begin.x[m];
        run.now_p[m] = train.mass[m] * begin.v[m];
    }
    sum_rows_twice<L>(contacts.share, run.now_q, run.now_p, run.q, run.p);
    sum_rows<L>(contacts.share, march.first.force, run.force);
}

// `wave` of all modes.
template <int L>
inline void waves(const ModalMotion& motion, double t, double* cosine, double* sine) {
    for (int m = 0; m < L; ++m) {
        Wave at = wave(motion.damping[m], motion.rate[m], motion.slow[m], motion.fast[m], t);
        cosine[m] = at.cosine;
        sine[m] = at.sine;
    }
}

// Free motions of all modes at the nodes of a step of h, and the rest as it is at the start.
template <int L>
void set_step(Propagation& run, double h) {
    run.motion.step = h;
    double rest[L];
    for (int m = 0; m < L; ++m) {
        bool free = is_free(run.motion.square[m], run.motion.damping[m], h);
        run.spring[m] = free ? 0.0 : run.motion.square[m];
        run.damper[m] = free ? 0.0 : run.motion.damping[m];
        rest[m] = run.force[m] + run.damper[m] * run.p[m] + run.spring[m] * run.q[m];
    }
    for (int n = 0; n < run.nodes.count; ++n) {
        waves<L>(run.motion, run.nodes.abscissa[n] * h, run.cosine[n], run.sine[n]);
        copy<L>(rest, run.rest[n]);
    }
}

// Whether a step of h keeps its digits. A mode that creeps for much longer than the step is a small
// difference of a polynomial and a wave, both larger by the square of that ratio.
inline bool resolves(const Propagation& run, std::int64_t bodies, double h) {
    for (std::int64_t m = 0; m < bodies; ++m) {
        double square = run.motion.square[m], damping = run.motion.damping[m];
        if (!is_free(square, damping, h) && damping > LONGEST_MEMORY * square * h) return false;
    }
    return true;
}

// Coefficient of (t/h)^k in the polynomial through the rest of mode m.
inline double power(const Propagation& run, std::int64_t k, int m) {
    const double* c = run.nodes.coefficient[k];
    double low = c[0] * run.rest[0][m] + c[1] * run.rest[1][m] + c[2] * run.rest[2][m];
    return low + c[3] * run.rest[3][m] + c[4] * run.rest[4][m];
}

// The motion of all modes under the polynomial through `rest`.
template <int L>
void respond(Propagation& run) {
    ModalMotion& motion = run.motion;
    const double h = motion.step, square = h * h, inertia = 1.0 / (h * h), per_step = 1.0 / h;
    for (int m = 0; m < L; ++m) {
        double spring = run.spring[m], loss = run.damper[m] * per_step;
        bool free = spring + loss == 0.0;
        double inverse = 1.0 / (free ? 1.0 : spring);
        double a = power(run, 0, m), b = power(run, 1, m), c = power(run, 2, m);
        double d = power(run, 3, m), e = power(run, 4, m);
        // w^2 y_k + (k + 1) c/h y_(k+1) + (k + 1) (k + 2)/h^2 y_(k+2) is the rest's coefficient.
        double four = e * inverse;
        double three = (d - 4.0 * loss * four) * inverse;
        double two = (c - 3.0 * loss * three - 12.0 * inertia * four) * inverse;
        double one = (b - 2.0 * loss * two - 6.0 * inertia * three) * inverse;
        double zero = (a - loss * one - 2.0 * inertia * two) * inverse;
        double q = run.q[m], p = run.p[m];
        motion.particular[0][m] = free ? q : zero;
        motion.particular[1][m] = free ? h * p : one;
        motion.particular[2][m] = free ? square / 2.0 * a : two;
        motion.particular[3][m] = free ? square / 6.0 * b : three;
        motion.particular[4][m] = free ? square / 12.0 * c : four;
        motion.particular[5][m] = free ? square / 20.0 * d : 0.0;
        motion.particular[6][m] = free ? square / 30.0 * e : 0.0;
        motion.free[0][m] = free ? 0.0 : q - zero;
        motion.free[1][m] = free ? 0.0 : p - one * per_step;
    }
}

// q and q' of all modes at t/h, from `waves` at that time.
template <int L>
inline void modal_states(const ModalMotion& motion, double t, const double* cosine,
                         const double* sine, double* q, double* p) {
    const double per_step = 1.0 / motion.step;
    const double(*y)[BODIES] = motion.particular;
    for (int m = 0; m < L; ++m) {
        double a = y[0][m], b = y[1][m], c = y[2][m], d = y[3][m];
        double e = y[4][m], f = y[5][m], g = y[6][m];
        double u = motion.free[0][m], w = motion.free[1][m];
        double value = a + t * (b + t * (c + t * (d + t * (e + t * (f + t * g)))));
        double slope = b + t * (2.0 * c + t * (3.0 * d + t * (4.0 * e + t * (5.0 * f + t * 6.0 * g))));
        double rate = (cosine[m] - motion.damping[m] * sine[m]) * w;
        rate -= motion.square[m] * sine[m] * u;
        q[m] = value + cosine[m] * u + sine[m] * w;
        p[m] = slope * per_step + rate;
    }
}

// q and q' of all modes at any time within the step, in `now_q` and `now_p`.
template <int L>
void modes_at(Propagation& run, double delay) {
    double cosine[L], sine[L];
    waves<L>(run.motion, delay, cosine, sine);
    modal_states<L>(run.motion, delay / run.motion.step, cosine, sine, run.now_q, run.now_p);
}

// x and v at any time within the step.
template <int L>
void propagate(March& march, double delay, double* x, double* v) {
    Propagation& run = march.run;
    modes_at<L>(run, delay);
    sum_rows_twice<L>(contacts_of(run).form, run.now_q, run.now_p, x, v);
}

// Trim of the speed loops, the integral of set-point minus speed.
inline void trim_at(const Model& model, const March& march, double delay, const double* x,
                    double* trim) {
    const Train& train = model.train;
    const State& begin = march.begin;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        std::int64_t motor = train.coupling[2 * a][0];
        double lag = begin.set_speed[a] - begin.speed[a] + 0.5 * march.moment.slew[a] * delay;
        double turned = (x[motor] - begin.x[motor]) * train.inverse_radius[motor];
        trim[a] = begin.trim[a] + lag * delay - turned;
    }
}

// Answer the rest as it is now, and move on to where that takes the nodes.
template <int L>
void visit_nodes(const Model& model, March& march) {
    Propagation& run = march.run;
    respond<L>(run);
    const Nodes& nodes = run.nodes;
    const ContactState& contacts = contacts_of(run);
    std::int64_t last = nodes.count - 1;
    copy<L>(run.node_d[last], run.before_d);
    copy<L>(run.node_rate[last], run.before_rate);
    copy<L>(run.node_v[last], run.before_v);
    for (int n = 0; n < nodes.count; ++n) {
        double t = nodes.abscissa[n], *q = run.node_q[n], *p = run.node_p[n];
        modal_states<L>(run.motion, t, run.cosine[n], run.sine[n], q, p);
        sum_rows_twice<L>(contacts.form, q, p, run.node_x[n], run.node_v[n]);
        sum_rows_twice<L>(contacts.motion, q, p, run.node_d[n], run.node_rate[n]);
        trim_at(model, march, t * run.motion.step, run.node_x[n], run.node_trim[n]);
    }
}

}  // namespace gearbox
