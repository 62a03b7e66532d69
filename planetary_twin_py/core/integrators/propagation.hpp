#pragma once

// A step whose meshes move exactly, under a polynomial for all that is not linear.
//
// M x'' = F(t, x, v) reads q'' + c q' + w^2 q = rest in the modes of the meshes in contact. The
// rest is friction, machines, errors of form, damping out of proportion, stiffness that changes
// within its segment; a polynomial through its values at the nodes of the step is answered exactly,
// at the nodes and at any time between them: by a polynomial and a free wave. A mode that hardly
// moves of its own within the step counts as a free mass, its spring and damper as part of the
// rest.

#include <algorithm>
#include <cmath>

#include "integrators/contact_modes.hpp"
#include "integrators/march_record.hpp"
#include "integrators/oscillator.hpp"
#include "train/model.hpp"
#include "vector/rows.hpp"

namespace gearbox {

inline constexpr double LONGEST_MEMORY = 1e3;  // c/(w^2 h) of a mode whose motion keeps ten digits

// Relative change of the damping times for which the modes keep their damping.
inline constexpr double DAMPING_KEPT = 5e-3;
// Terms of the series of a free wave a little later, and the phase for which it keeps eleven
// digits.
inline constexpr int FEW_TERMS = 5, MANY_TERMS = 9;
inline constexpr double FEW_SHIFTED = 0.02, MANY_SHIFTED = 0.3;

inline ContactState& contacts_of(Propagation& run) {
    return run.known.states[run.motion.modes];
}
inline const ContactState& contacts_of(const Propagation& run) {
    return run.known.states[run.motion.modes];
}

// `wave` of all modes.
template <int L>
inline void waves(const ModalMotion& motion, double t, double* cosine, double* sine) {
#pragma GCC ivdep
    for (int m = 0; m < L; ++m) {
        Wave at = wave(motion.damping[m], motion.rate[m], motion.slow[m], motion.fast[m], t);
        cosine[m] = at.cosine;
        sine[m] = at.sine;
    }
}

// Damp the modes of a contact state as its meshes are damped now. What the damping is off by later
// is part of the rest.
template <int L>
void damp_modes(ContactState& contacts, const double* tau) {
    bool near = std::fabs(tau[0] - contacts.tau[0]) <= DAMPING_KEPT * contacts.tau[0] &&
                std::fabs(tau[1] - contacts.tau[1]) <= DAMPING_KEPT * contacts.tau[1];
    if (near) return;
    contacts.tau[0] = tau[0];
    contacts.tau[1] = tau[1];
    contacts.waves_step = 0.0;
    for (int m = 0; m < L; ++m) {
        double damping = contacts.shaft_damping[m] + tau[0] * contacts.mesh_damping[0][m];
        damping += tau[1] * contacts.mesh_damping[1][m];
        DecayRates rates = decay_rates(contacts.square[m], damping);
        contacts.damping[m] = damping;
        contacts.rate[m] = rates.rate;
        contacts.slow[m] = rates.slow;
        contacts.fast[m] = rates.fast;
    }
}

// Express the start of a step in the modes of its contacts.
template <int L>
void enter(const Model& model, March& march) {
    using V = Row<L>;
    const Train& train = model.train;
    Propagation& run = march.run;
    ModalMotion& motion = run.motion;
    motion.modes = find_modes(train, march.begin, run.known);
    ContactState& contacts = contacts_of(run);
    damp_modes<L>(contacts, march.moment.tau);
    copy<L>(contacts.square, motion.square);
    copy<L>(contacts.damping, motion.damping);
    copy<L>(contacts.rate, motion.rate);
    copy<L>(contacts.slow, motion.slow);
    copy<L>(contacts.fast, motion.fast);
    V mass(train.mass);
    (mass * V(march.begin.x)).store(run.now_q);
    (mass * V(march.begin.v)).store(run.now_p);
    sum_rows_twice<L>(contacts.share, run.now_q, run.now_p, run.q, run.p);
    sum_rows<L>(contacts.share, march.first.force, run.force);
}

// Largest part of a period or a decay of any mode within a time, where modes are not free masses.
template <int L>
double phase_within(const Propagation& run, double time) {
    using V = Row<L>;
    V square(run.spring), pace = square_root(square) + V(run.damper);
    return largest(pace) * std::fabs(time);
}

// Free waves a little later (Taylor): C' = -w^2 S, S' = C - c S.
template <int L, int TERMS>
LAW void shift_waves(const ModalMotion& motion, double delay, const double* from_cosine,
                     const double* from_sine, double* cosine, double* sine) {
    using V = Row<L>;
    V square(motion.square), damping(motion.damping), c(from_cosine), s(from_sine);
    V sum_c = c, sum_s = s;
    for (int k = 1; k <= TERMS; ++k) {
        const double part = delay / k;
        V next_c = square * s * -part, next_s = (c - damping * s) * part;
        c = next_c;
        s = next_s;
        sum_c += c;
        sum_s += s;
    }
    sum_c.store(cosine);
    sum_s.store(sine);
}

// Free waves at the nodes of a step that is longer than the one they are kept of.
template <int L, int TERMS>
void shift_all_waves(Propagation& run, const ContactState& kept, double longer) {
    for (int n = 0; n < run.nodes.count; ++n)
        shift_waves<L, TERMS>(run.motion, run.nodes.abscissa[n] * longer, kept.cosine[n],
                              kept.sine[n], run.cosine[n], run.sine[n]);
}

// Free motions at the nodes; `fresh`: of the first step in a contact state, which are kept for the
// next such step.
template <int L>
void find_waves(Propagation& run, double h, bool fresh) {
    ContactState& contacts = contacts_of(run);
    const double longer = h - contacts.waves_step;
    if (fresh && contacts.waves_step > 0.0 && contacts.waves_nodes == run.nodes.count) {
        const double phase = phase_within<L>(run, longer);
        if (phase <= FEW_SHIFTED) return shift_all_waves<L, FEW_TERMS>(run, contacts, longer);
        if (phase <= MANY_SHIFTED) return shift_all_waves<L, MANY_TERMS>(run, contacts, longer);
    }
    for (int n = 0; n < run.nodes.count; ++n) {
        waves<L>(run.motion, run.nodes.abscissa[n] * h, run.cosine[n], run.sine[n]);
        if (!fresh) continue;
        copy<L>(run.cosine[n], contacts.cosine[n]);
        copy<L>(run.sine[n], contacts.sine[n]);
    }
    if (!fresh) return;
    contacts.waves_step = h;
    contacts.waves_nodes = run.nodes.count;
}

// Free motions of all modes at the nodes of a step of h, and the rest as it is at the start.
template <int L>
void set_step(Propagation& run, double h, bool fresh) {
    using V = Row<L>;
    run.motion.step = h;
    V square(run.motion.square), damping(run.motion.damping);
    Mask<L> free = square * h * h + damping * h < FREE_MASS;
    V spring = select(free, 0.0, square), damper = select(free, 0.0, damping);
    V rest = V(run.force) + damper * V(run.p) + spring * V(run.q);
    spring.store(run.spring);
    damper.store(run.damper);
    find_waves<L>(run, h, fresh);
    for (int n = 0; n < run.nodes.count; ++n) rest.store(run.rest[n]);
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

// Coefficients of (t/h)^k in the polynomials through the rest of all modes.
template <int L>
LAW Row<L> power(const Propagation& run, std::int64_t k) {
    using V = Row<L>;
    const double* c = run.nodes.coefficient[k];
    V low = c[0] * V(run.rest[0]) + c[1] * V(run.rest[1]) + c[2] * V(run.rest[2]);
    return low + c[3] * V(run.rest[3]) + c[4] * V(run.rest[4]);
}

// The motion of all modes under the polynomial through `rest`.
template <int L>
void respond(Propagation& run) {
    using V = Row<L>;
    ModalMotion& motion = run.motion;
    const double h = motion.step, square = h * h, inertia = 1.0 / (h * h), per_step = 1.0 / h;
    V spring(run.spring), loss = V(run.damper) * per_step;
    Mask<L> free = spring + loss == 0.0;
    V inverse = 1.0 / select(free, 1.0, spring);
    V a = power<L>(run, 0), b = power<L>(run, 1), c = power<L>(run, 2);
    V d = power<L>(run, 3), e = power<L>(run, 4);
    // w^2 y_k + (k + 1) c/h y_(k+1) + (k + 1) (k + 2)/h^2 y_(k+2) is the rest's coefficient.
    V four = e * inverse;
    V three = (d - 4.0 * loss * four) * inverse;
    V two = (c - 3.0 * loss * three - 12.0 * inertia * four) * inverse;
    V one = (b - 2.0 * loss * two - 6.0 * inertia * three) * inverse;
    V zero = (a - loss * one - 2.0 * inertia * two) * inverse;
    V q(run.q), p(run.p);
    select(free, q, zero).store(motion.particular[0]);
    select(free, h * p, one).store(motion.particular[1]);
    select(free, square / 2.0 * a, two).store(motion.particular[2]);
    select(free, square / 6.0 * b, three).store(motion.particular[3]);
    select(free, square / 12.0 * c, four).store(motion.particular[4]);
    select(free, square / 20.0 * d, 0.0).store(motion.particular[5]);
    select(free, square / 30.0 * e, 0.0).store(motion.particular[6]);
    select(free, 0.0, q - zero).store(motion.free[0]);
    select(free, 0.0, p - one * per_step).store(motion.free[1]);
}

// q and q' of all modes at t/h, from `waves` at that time.
template <int L>
LAW void modal_states(const ModalMotion& motion, double t, const double* cosine, const double* sine,
                      double* q, double* p) {
    using V = Row<L>;
    const double per_step = 1.0 / motion.step;
    const double (*y)[BODIES] = motion.particular;
    V a(y[0]), b(y[1]), c(y[2]), d(y[3]), e(y[4]), f(y[5]), g(y[6]);
    V u(motion.free[0]), w(motion.free[1]), first(cosine), second(sine);
    V value = a + t * (b + t * (c + t * (d + t * (e + t * (f + t * g)))));
    V slope = b + t * (2.0 * c + t * (3.0 * d + t * (4.0 * e + t * (5.0 * f + t * 6.0 * g))));
    V rate = (first - V(motion.damping) * second) * w - V(motion.square) * second * u;
    (value + first * u + second * w).store(q);
    (slope * per_step + rate).store(p);
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

// Modes and meshes at node n.
template <int L>
LAW void move_node(Propagation& run, const ContactState& contacts, std::int64_t n) {
    double *q = run.node_q[n], *p = run.node_p[n];
    modal_states<L>(run.motion, run.nodes.abscissa[n], run.cosine[n], run.sine[n], q, p);
    sum_rows_twice<L>(contacts.motion, q, p, run.node_d[n], run.node_rate[n]);
}

// Bodies at node n, and the trim of the speed loops.
template <int L>
LAW void move_bodies(const Model& model, March& march, const ContactState& contacts,
                     std::int64_t n) {
    Propagation& run = march.run;
    sum_rows_twice<L>(contacts.form, run.node_q[n], run.node_p[n], run.node_x[n], run.node_v[n]);
    double delay = run.nodes.abscissa[n] * run.motion.step;
    trim_at(model, march, delay, run.node_x[n], run.node_trim[n]);
}

// Answer the rest as it is now, and move on to where that takes the nodes: their modes and meshes,
// and the bodies at the last.
template <int L>
void visit_last_node(const Model& model, March& march) {
    Propagation& run = march.run;
    respond<L>(run);
    const ContactState& contacts = contacts_of(run);
    const std::int64_t last = run.nodes.count - 1;
    copy<L>(run.node_d[last], run.before_d);
    copy<L>(run.node_rate[last], run.before_rate);
    copy<L>(run.node_v[last], run.before_v);
    for (std::int64_t n = 0; n <= last; ++n) move_node<L>(run, contacts, n);
    move_bodies<L>(model, march, contacts, last);
}

// The bodies at the other nodes, which another sweep asks for.
template <int L>
void visit_other_nodes(const Model& model, March& march) {
    const ContactState& contacts = contacts_of(march.run);
    for (std::int64_t n = 0; n < march.run.nodes.count - 1; ++n)
        move_bodies<L>(model, march, contacts, n);
}

template <int L>
void visit_nodes(const Model& model, March& march) {
    visit_last_node<L>(model, march);
    visit_other_nodes<L>(model, march);
}

}  // namespace gearbox
