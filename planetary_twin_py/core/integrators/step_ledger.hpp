#pragma once

// The energy ledger of a collocation step.

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SLOWEST_SWING =
    30.0;  // (1 + c h)/(w h)^2, cancellation grows with its 4th power

// Fill the weights of the nodes in the integral over the part t of the step [s].
inline void weigh_nodes(Propagation& run, double t) {
    Row<8> weight(0.0);
    for (std::int64_t k = run.nodes.count - 1; k >= 0; --k)
        weight = fused(weight, t, Row<8>(run.nodes.integral[k]));
    (t * run.motion.step * weight).store(run.weight);
}

// Modes with free waves whose dissipation quadrature may not resolve. Not those that hardly move
// within the step: `damped` would suffer from cancellation, quadrature is accurate.
template <int L>
ALWAYS_INLINE Mask<L> swings(const Propagation& run) {
    const double h = run.motion.step;
    Row<L> stiff = Row<L>(run.spring) * (h * h), loss = Row<L>(run.damper) * h;
    return (loss > 0.0) & (1.0 + loss < SLOWEST_SWING * stiff);
}

// Integral of c q'^2 over the part of the step for modes with free waves [J].
//
// q' is a polynomial y'(t) and the rate of a free motion u. The latter alone dissipates c int u'^2,
// the decrease of (u'^2 + w^2 u^2)/2; int t^k u' and int t^k u follow from each other by u'' + c u'
// + w^2 u = 0.
template <int L>
ALWAYS_INLINE Row<L> damped(const Propagation& run, double part) {
    using V = Row<L>;
    const ModalMotion& motion = run.motion;
    const double h = part * motion.step, per_h = 1.0 / h;
    V c(motion.damping), square(motion.square), cosine(run.end_cosine), sine(run.end_sine);
    V u0(motion.free[0]), w0(motion.free[1]);
    V u1 = fused(cosine, u0, sine * w0);
    V w1 = fused(fused(-c, sine, cosine), w0, -(square * sine) * u0);
    V fall = w0 - w1, rate0 = u1 - u0;  // the latter: integral of u', then of s^k u', s = t/h
    V lost = 0.5 * fused(fall, w0 + w1, -(square * rate0) * (u0 + u1));
    V inverse = V(run.flexibility) * per_h, fading = -c;
    V value0 = fused(fading, rate0, fall) * inverse;  // of s^k u over h
    V rate1 = u1 - value0;
    V value1 = fused(fading, rate1, fused(rate0, per_h, -w1)) * inverse;
    V rate2 = fused(-2.0, value1, u1);
    V value2 = fused(fading, rate2, fused(rate1, 2.0 * per_h, -w1)) * inverse;
    V rate3 = fused(-3.0, value2, u1);
    // y' = (a + b s + d s^2 + e s^3)/step
    const double (*y)[BODIES] = motion.particular;
    const double part2 = part * part;
    V a(y[1]), b = 2.0 * part * V(y[2]), d = 3.0 * part2 * V(y[3]),
               e = 4.0 * part2 * part * V(y[4]);
    V cross = fused(a, rate0, fused(b, rate1, fused(d, rate2, e * rate3)));
    V own = a * fused(0.5, e, fused(2.0 / 3.0, d, a + b));
    own = fused(b, fused(0.4, e, fused(0.5, d, b * (1.0 / 3.0))), own);
    own = fused(d, fused(1.0 / 3.0, e, d * 0.2), own);
    own = fused(e, e * (1.0 / 7.0), own);
    return fused(c * motion.per_step, fused(own, part, cross + cross), lost);
}

// Sum of a row over all meshes and their copies.
template <int L>
ALWAYS_INLINE double sum_of_meshes(const Train& train, const Row<L>& row) {
    return total(Row<L>(train.mesh.copies) * row);
}

// Fill the ledger h seconds after the start of the step, by quadrature at the nodes; the
// dissipation of modes with free waves is known exactly.
template <int L>
void integrate_powers(const Train& train, Integrator& integrator, double h) {
    using V = Row<L>;
    using OfMeshes = Row<MESH_LANES<L>>;
    Propagation& run = integrator.run;
    const double part = h / run.motion.step;
    weigh_nodes(run, part);
    double gained[LEDGER] = {};
    V quadrature(0.0);
    OfMeshes lost(0.0), work(0.0), friction(0.0);
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        const double weight = run.weight[n];
        const Node& node = run.node[n];
        for (int e = 0; e < LEDGER; ++e) gained[e] += weight * node.power[e];
        V rate(node.p);
        quadrature = fused(weight * rate, rate, quadrature);
        lost = fused(weight, OfMeshes(node.meshes.damping_power), lost);
        work = fused(weight, OfMeshes(node.meshes.stiffness_power), work);
        friction = fused(weight, OfMeshes(node.friction.drag.power), friction);
    }
    V exact = fused(-V(run.motion.damping), quadrature, damped<L>(run, part));
    gained[DAMPING] += sum_of_meshes(train, lost) + total(select(swings<L>(run), exact, 0.0));
    gained[STIFFNESS_WORK] += sum_of_meshes(train, work);
    if (train.friction) {
        gained[FRICTION] += sum_of_meshes(train, friction);
        const OfMeshes external(integrator.constants.external);
        gained[HEAT + HEAT_SUN_MESHES] +=
            sum_of_meshes(train, select(external > 0.0, friction, 0.0));
        gained[HEAT + HEAT_RING_MESHES] +=
            sum_of_meshes(train, select(external > 0.0, 0.0, friction));
    }
    for (int e = 0; e < LEDGER; ++e)
        integrator.end.energy[e] = integrator.begin.energy[e] + gained[e];
}

}  // namespace gearbox
