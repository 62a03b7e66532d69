#pragma once

// A step with the exact linear motion of the meshes; all other terms are polynomials.
//
// In the modes of the meshes in contact, M x'' = F(t, x, v) is q'' + c q' + w^2 q = remainder. The
// remainder contains friction, machines, errors of form, damping that is not proportional, and
// changes of the stiffness within its segment. It is interpolated by a polynomial through its
// values at the nodes of the step, under which the motion is known exactly at any time within the
// step: a polynomial and a free wave. A mode whose spring and damper are negligible within the step
// counts as a free mass, their forces as part of the remainder.

#include <algorithm>
#include <cmath>

#include "integrators/contact_modes.hpp"
#include "integrators/given_motion.hpp"
#include "integrators/integrator_record.hpp"
#include "integrators/oscillator.hpp"
#include "lubrication/tooth_friction.hpp"
#include "model/model.hpp"
#include "vector/rows.hpp"

namespace gearbox {

inline constexpr double LONGEST_MEMORY = 1e3;  // c/(w^2 h): ten digits are accurate
inline constexpr double ROUNDED_UP = 1.0 + 1e-12;

// Relative change of the damping times below which the damping of the modes is not updated.
inline constexpr double DAMPING_KEPT = 5e-3;
// Number of terms of the series of a free wave a short time later, by its phase, that makes it
// accurate to thirteen digits: the energy ledger has small differences of waves. Two terms, for
// steps between the same edges in a later mesh cycle, to eleven.
inline int terms_of_shift(double phase) {
    if (phase <= 0.04) return phase <= 3e-4 ? 2 : phase <= 0.02 ? 5 : 6;
    return phase <= 0.08 ? 7 : phase <= 0.15 ? 9 : 11;
}
inline constexpr double FURTHEST_SHIFT = 0.3;  // phase up to which the series is used
inline constexpr double INVERSE[] = {0.0,       1.0,       1.0 / 2.0,  1.0 / 3.0,
                                     1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0,  1.0 / 7.0,
                                     1.0 / 8.0, 1.0 / 9.0, 1.0 / 10.0, 1.0 / 11.0};

inline ContactState& contacts_of(Propagation& run) {
    return run.known.states[run.motion.contact_state];
}
inline const ContactState& contacts_of(const Propagation& run) {
    return run.known.states[run.motion.contact_state];
}

// Bounds for damping times up to tau, which may change by DAMPING_KEPT without an update.
//
// From (1, 0): C - tau w^2 S; from (0, 1): S + tau (C - c S); S never exceeds 1/w, nor C 1.
template <int L>
WaveBounds bound_waves(const ContactState& contacts, double tau) {
    using V = Row<L>;
    V square(contacts.square), damping(contacts.damping);
    Mask<L> underdamped = V(contacts.slow_rate) == V(contacts.fast_rate);
    V longest = 1.0 / square_root(larger(square, V(SMALLEST)));
    V inverse = 1.0 / larger(V(contacts.rate), V(SMALLEST));
    longest = select(underdamped, smaller(longest, inverse), longest);
    // The slope is linear in tau: largest at an end.
    V slope = larger(absolute(0.5 * damping - tau * square), 0.5 * damping);
    slope += DAMPING_KEPT * tau * square;
    V ratio = slope * inverse, first = 1.0 + slope * longest;
    first = select(underdamped, smaller(first, square_root(1.0 + ratio * ratio)), first);
    WaveBounds bounds;
    first.store(bounds.displaced);
    (longest + tau * (1.0 + DAMPING_KEPT)).store(bounds.moving);
    // u'^2 + w^2 u^2 falls, and u'' = -c u' - w^2 u.
    V w(contacts.natural), bend = damping + w;
    bend += tau * (1.0 + DAMPING_KEPT) * (damping * bend + square);
    (w * bend).store(bounds.displaced_bend);
    bend.store(bounds.moving_bend);
    const MatrixRows magnitude = contacts.matrices.motion_magnitude();
    for (int m = 0; m < L; ++m) bounds.motion[m] = largest(Row<MESH_LANES<L>>(magnitude[m]));
    return bounds;
}

// Set the damping of the modes of a contact state to the present one of its meshes. Later
// differences are part of the remainder.
template <int L>
void damp_modes(ContactState& contacts, const double* tau) {
    bool near = std::fabs(tau[0] - contacts.tau[0]) <= DAMPING_KEPT * contacts.tau[0] &&
                std::fabs(tau[1] - contacts.tau[1]) <= DAMPING_KEPT * contacts.tau[1];
    if (near) return;
    contacts.tau[0] = tau[0];
    contacts.tau[1] = tau[1];
    for (StoredWaves& waves : contacts.waves) waves.step = 0.0;
    for (int m = 0; m < L; ++m) {
        double damping = contacts.shaft_damping[m] + tau[0] * contacts.mesh_damping[0][m];
        damping += tau[1] * contacts.mesh_damping[1][m];
        DecayRates rates = decay_rates(contacts.square[m], damping);
        contacts.damping[m] = damping;
        contacts.rate[m] = rates.rate;
        contacts.slow_rate[m] = rates.slow_rate;
        contacts.fast_rate[m] = rates.fast_rate;
    }
    contacts.fastest_rate = largest(Row<L>(contacts.natural) + Row<L>(contacts.damping));
    contacts.bounds = bound_waves<L>(contacts, std::max(tau[0], tau[1]));
}

// Free waves `delay` seconds after those with this cosine and sine by Taylor series: C' = -w^2 S,
// S' = C - c S.
template <int L>
NOINLINE void shift_waves(const ModalMotion& motion, double delay, int terms,
                          const double* from_cosine, const double* from_sine, double* cosine,
                          double* sine) {
    using V = Row<L>;
    V square(motion.square), damping(motion.damping), c(from_cosine), s(from_sine);
    V sum_c = c, sum_s = s;
#pragma GCC unroll 1
    for (int k = 1; k <= terms; ++k) {
        const double part = delay * INVERSE[k];
        V next_c = square * s * -part, next_s = fused(-damping, s, c) * part;
        c = next_c;
        s = next_s;
        sum_c += c;
        sum_s += s;
    }
    sum_c.store(cosine);
    sum_s.store(sine);
}

// Cosines and sines at time zero.
struct AtStart {
    alignas(64) double one[BODIES];
    alignas(64) double zero[BODIES];

    constexpr AtStart() : one{}, zero{} {
        for (double& value : one) value = 1.0;
    }
};
inline constexpr AtStart AT_START;

// `wave` of all modes; by its series for times much shorter than all periods and decay times.
template <int L>
NOINLINE void waves(const ModalMotion& motion, double t, double* cosine, double* sine) {
    const double phase = motion.fastest_rate * std::fabs(t);
    if (phase <= FURTHEST_SHIFT)
        return shift_waves<L>(motion, t, terms_of_shift(phase), AT_START.one, AT_START.zero, cosine,
                              sine);
#pragma GCC ivdep
    for (int m = 0; m < L; ++m) {
        Wave at =
            wave(motion.damping[m], motion.rate[m], motion.slow_rate[m], motion.fast_rate[m], t);
        cosine[m] = at.cosine;
        sine[m] = at.sine;
    }
}

// Returns the free waves at time t_a + t_b from those at t_a and at t_b (angle-sum formula).
template <int L>
struct Waves {
    Row<L> cosine, sine;
};

template <int L>
ALWAYS_INLINE Waves<L> waves_at(const ModalMotion& motion, double t) {
    alignas(64) double cosine[L], sine[L];
    waves<L>(motion, t, cosine, sine);
    return {Row<L>(cosine), Row<L>(sine)};
}

template <int L>
ALWAYS_INLINE Waves<L> waves_after(const ModalMotion& motion, const Waves<L>& a,
                                   const Waves<L>& b) {
    using V = Row<L>;
    V rate = a.cosine - V(motion.damping) * a.sine;
    return {a.cosine * b.cosine - V(motion.square) * a.sine * b.sine,
            a.sine * b.cosine + rate * b.sine};
}

// Free waves at the nodes of a step from stored ones of a shorter step.
template <int L>
void shift_all_waves(Propagation& run, const StoredWaves& stored, double longer, int terms) {
    for (int n = 0; n < run.nodes.count; ++n)
        shift_waves<L>(run.motion, run.nodes.abscissa[n] * longer, terms, stored.cosine[n],
                       stored.sine[n], run.cosine[n], run.sine[n]);
}

// Free motions at the nodes of a step of h, from those of an equally long step if stored.
template <int L>
void find_waves(Propagation& run, double h) {
    const std::int64_t place = run.steps_in_contact_state;
    StoredWaves* stored = place < STORED_STEPS ? &contacts_of(run).waves[place] : nullptr;
    if (stored && stored->step > 0.0 && stored->nodes == run.nodes.count) {
        const double longer = h - stored->step, phase = run.motion.fastest_rate * std::fabs(longer);
        if (phase <= FURTHEST_SHIFT)
            return shift_all_waves<L>(run, *stored, longer, terms_of_shift(phase));
    }
    for (int n = 0; n < run.nodes.count; ++n) {
        waves<L>(run.motion, run.nodes.abscissa[n] * h, run.cosine[n], run.sine[n]);
        if (!stored) continue;
        copy<L>(run.cosine[n], stored->cosine[n]);
        copy<L>(run.sine[n], stored->sine[n]);
    }
    if (!stored) return;
    stored->step = h;
    stored->nodes = run.nodes.count;
}

// Free motions of all modes at the nodes of a step of h, and the remainder at the start.
template <int L>
void set_step(Propagation& run, double h) {
    using V = Row<L>;
    run.motion.step = h;
    run.motion.per_step = 1.0 / h;
    V square(run.motion.square), damping(run.motion.damping);
    Mask<L> free = square * h * h + damping * h < FREE_MASS;
    const ContactState& contacts = contacts_of(run);
    V spring = select(free, 0.0, square), damper = select(free, 0.0, damping);
    V remainder = V(run.force) + damper * V(run.start.p) + spring * V(run.start.q);
    spring.store(run.spring);
    damper.store(run.damper);
    select(spring + damper == 0.0, 1.0, V(contacts.flexibility)).store(run.flexibility);
    find_waves<L>(run, h);
    for (int n = 0; n < run.nodes.count; ++n) {
        remainder.store(run.remainder[n]);
        copy<L>(run.start.friction_force, run.node[n].friction_force);
    }
}

// Whether a step of h loses no accuracy by cancellation. The motion of a mode with a decay time
// much longer than the step is a small difference of a polynomial and a wave, both larger by the
// square of that ratio.
template <int L>
bool resolves(const Propagation& run, double h) {
    Row<L> square(run.motion.square), damping(run.motion.damping);
    Mask<L> free = square * h * h + damping * h < FREE_MASS;
    Mask<L> cancels = damping > LONGEST_MEMORY * square * h;
    return none(cancels & !free);
}

// The shortest step of at least h seconds that loses no accuracy by cancellation.
template <int L>
double shortest_resolved(const Propagation& run, std::int64_t bodies, double h) {
    if (resolves<L>(run, h)) return h;
    for (std::int64_t m = 0; m < bodies; ++m) {
        double square = run.motion.square[m], damping = run.motion.damping[m];
        if (!is_free(square, damping, h))
            h = std::max(h, ROUNDED_UP * damping / (LONGEST_MEMORY * square));
    }
    return h;
}

// Coefficients of (t/h)^k in the polynomials through the remainder of all modes.
template <int L>
ALWAYS_INLINE Row<L> power(const Propagation& run, std::int64_t k) {
    using V = Row<L>;
    const double* c = run.nodes.coefficient[k];
    V sum = c[0] * V(run.remainder[0]);
    for (std::int64_t n = 1; n < run.nodes.count; ++n) sum = fused(c[n], V(run.remainder[n]), sum);
    return sum;
}

// Motion of all modes under the polynomial through `remainder`.
template <int L>
void respond(Propagation& run) {
    using V = Row<L>;
    ModalMotion& motion = run.motion;
    const double h = motion.step, square = h * h, per_step = motion.per_step;
    const double inertia = per_step * per_step;
    V spring(run.spring), loss = V(run.damper) * per_step;
    Mask<L> free = spring + loss == 0.0;
    V inverse(run.flexibility);
    V a = power<L>(run, 0), b = power<L>(run, 1), c = power<L>(run, 2);
    V d(0.0), e(0.0);
    if (run.nodes.count > 3) d = power<L>(run, 3);
    if (run.nodes.count > 4) e = power<L>(run, 4);
    // w^2 y_k + (k + 1) c/h y_(k+1) + (k + 1) (k + 2)/h^2 y_(k+2) is the coefficient of the
    // remainder.
    V four = e * inverse;
    V three = (d - 4.0 * loss * four) * inverse;
    V two = (c - 3.0 * loss * three - 12.0 * inertia * four) * inverse;
    V one = (b - 2.0 * loss * two - 6.0 * inertia * three) * inverse;
    V zero = (a - loss * one - 2.0 * inertia * two) * inverse;
    V q(run.start.q), p(run.start.p);
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
ALWAYS_INLINE RowPair<L> modal_states(const ModalMotion& motion, double t, const Row<L>& cosine,
                                      const Row<L>& sine) {
    using V = Row<L>;
    const double (*y)[BODIES] = motion.particular;
    V a(y[0]), b(y[1]), c(y[2]), d(y[3]), e(y[4]), f(y[5]), g(y[6]);
    V u(motion.free[0]), w(motion.free[1]);
    // Even and odd powers apart, which halves the latency.
    const double s = t * t;
    V even = fused(s, fused(s, fused(s, g, e), c), a), odd = fused(s, fused(s, f, d), b);
    V odd_slope = fused(s, fused(5.0 * s, f, 3.0 * d), b);
    V even_slope = fused(s, fused(6.0 * s, g, 4.0 * e), 2.0 * c);
    V value = fused(t, odd, even), slope = fused(t, even_slope, odd_slope);
    V fading = fused(-V(motion.damping), sine, cosine), stiff = V(motion.square) * sine;
    V wave_part = fused(cosine, u, sine * w), rate = fused(fading, w, -stiff * u);
    return {value + wave_part, fused(slope, motion.per_step, rate)};
}

// q and q' of all modes at any time within the step.
template <int L>
ALWAYS_INLINE RowPair<L> modes_at(const ModalMotion& motion, double delay) {
    Waves<L> at = waves_at<L>(motion, delay);
    return modal_states<L>(motion, delay * motion.per_step, at.cosine, at.sine);
}

// x and v at any time within the step.
template <int L>
void propagate(const Model& model, Integrator& integrator, double delay, double* x, double* v) {
    Propagation& run = integrator.run;
    auto [at, rate] =
        sum_rows<L>(contacts_of(run).matrices.shapes(), modes_at<L>(run.motion, delay));
    at.store(x);
    rate.store(v);
    move_given(model, integrator.begin, delay, x, v);
}

// Trim of the speed loops, the integral of set-point minus speed.
inline void trim_at(const Model& model, const Integrator& integrator, double delay, const double* x,
                    double* trim) {
    const Train& train = model.train;
    const State& begin = integrator.begin;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        std::int64_t motor = train.coupling.ends[2 * a][0];
        double lag =
            begin.set_speed[a] - begin.speed[a] + 0.5 * integrator.constants.slew[a] * delay;
        double turned = (x[motor] - begin.x[motor]) * train.body.inverse_radius[motor];
        trim[a] = begin.trim[a] + lag * delay - turned;
    }
}

// Speeds of the gears of closed flanks relative to their lines of action at a node, from the speeds
// of the bodies. Open flanks have no friction.
inline void turn_gears(const Train& train, const StepConstants& constants, Node& node) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (constants.side[i] == 0.0) continue;
        const double line = turning_of_line(train, i, node.v);
        for (int g = 0; g < GEARS - 1; ++g) {
            double turning = node.v[train.mesh.body[i][g]] * train.mesh.lever[g][i];
            node.spin[g][i] = constants.spin[g][i] + turning - line;
        }
    }
}

// Motion of bodies and meshes at a node from that of the modes.
template <int L>
ALWAYS_INLINE RowPair<L> move_bodies(const Model& model, const Integrator& integrator, double delay,
                                     const Waves<L>& at, Node& node) {
    constexpr int M = MESH_LANES<L>;
    const ModalMotion& motion = integrator.run.motion;
    const ModeMatrices& matrices = contacts_of(integrator.run).matrices;
    RowPair<L> modes = modal_states<L>(motion, delay * motion.per_step, at.cosine, at.sine);
    RowPair<M> meshes = sum_rows<M>(matrices.motion(), modes);
    RowPair<L> bodies = sum_rows<L>(matrices.shapes(), modes);
    modes.first.store(node.q);
    modes.second.store(node.p);
    meshes.first.store(node.d);
    meshes.second.store(node.rate);
    bodies.first.store(node.x);
    bodies.second.store(node.v);
    move_given(model, integrator.begin, delay, node.x, node.v);
    return modes;
}

// The same with the spin of the gears and the trim of the speed loops.
template <int L>
NOINLINE void move_node(const Model& model, const Integrator& integrator, double delay,
                        const Row<L>& cosine, const Row<L>& sine, Node& node) {
    const RowPair<L> modes = move_bodies<L>(model, integrator, delay, {cosine, sine}, node);
    if constexpr (MOVING) {
        turn_gears(model.train, integrator.constants, node);
    } else {
        constexpr int M = MESH_LANES<L>;
        const ModeMatrices& matrices = contacts_of(integrator.run).matrices;
        for (int g = 0; g < GEARS - 1; ++g)
            (Row<M>(integrator.constants.spin[g]) + sum_rows<M>(matrices.spin(g), modes.second))
                .store(node.spin[g]);
    }
    trim_at(model, integrator, delay, node.x, node.trim);
}

template <int L>
ALWAYS_INLINE void move_to(const Model& model, Integrator& integrator, std::int64_t n) {
    Propagation& run = integrator.run;
    move_node<L>(model, integrator, run.nodes.abscissa[n] * run.motion.step, Row<L>(run.cosine[n]),
                 Row<L>(run.sine[n]), run.node[n]);
}

// Compute the motion under the present remainder, and move all nodes accordingly.
template <int L>
void update_nodes(const Model& model, Integrator& integrator) {
    respond<L>(integrator.run);
    for (std::int64_t n = 0; n < integrator.run.nodes.count; ++n) move_to<L>(model, integrator, n);
}

// q of all modes at node n.
template <int L>
ALWAYS_INLINE Row<L> modal_places(const Propagation& run, std::int64_t n) {
    using V = Row<L>;
    const double (*y)[BODIES] = run.motion.particular;
    const double t = run.nodes.abscissa[n], s = t * t;
    V even = fused(s, fused(s, fused(s, V(y[6]), V(y[4])), V(y[2])), V(y[0]));
    V odd = fused(s, fused(s, V(y[5]), V(y[3])), V(y[1]));
    V wave_part =
        fused(V(run.cosine[n]), V(run.motion.free[0]), V(run.sine[n]) * V(run.motion.free[1]));
    return fused(t, odd, even) + wave_part;
}

// Compute the motion under the present remainder once more, and move the last node; of the other
// nodes only the transmission errors, the only quantities that are read from them in an accepted
// step.
template <int L>
void update_last_node(const Model& model, Integrator& integrator) {
    Propagation& run = integrator.run;
    respond<L>(run);
    constexpr int M = MESH_LANES<L>;
    const MatrixRows motion = contacts_of(run).matrices.motion();
    const std::int64_t last = run.nodes.count - 1;
    for (std::int64_t n = 0; n < last; ++n)
        sum_rows<M>(motion, modal_places<L>(run, n)).store(run.node[n].d);
    const Node& node = run.node[last];
    copy<M>(node.d, run.before_d);
    copy<M>(node.rate, run.before_rate);
    copy<L>(node.v, run.before_v);
    move_to<L>(model, integrator, last);
}

// The other nodes, for another sweep.
template <int L>
void update_other_nodes(const Model& model, Integrator& integrator) {
    for (std::int64_t n = 0; n < integrator.run.nodes.count - 1; ++n)
        move_to<L>(model, integrator, n);
}

}  // namespace gearbox
