#pragma once

// The energy ledger of a collocation step.

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SLOWEST_SWING =
    30.0;  // (1 + c h)/(w h)^2, cancellation grows with its 4th power

// Fill the weights of the nodes in the integral over the part t of the step [s].
inline void weigh_nodes(Propagation& run, double t) {
    double integral[MOST_NODES], power = run.motion.step;  // of powers of the time
    for (std::int64_t k = 0; k < run.nodes.count; ++k) {
        power *= t;
        integral[k] = power / static_cast<double>(k + 1);
    }
    for (std::int64_t n = 0; n < run.nodes.count; ++n) {
        run.weight[n] = 0.0;
        for (std::int64_t k = 0; k < run.nodes.count; ++k)
            run.weight[n] += run.nodes.coefficient[k][n] * integral[k];
    }
}

// Modes with free waves whose dissipation quadrature may not resolve. Not those that hardly move
// within the step: `damped` would suffer from cancellation, quadrature is accurate.
template <int L>
ALWAYS_INLINE Mask<L> swings(const Propagation& run) {
    const double h = run.motion.step;
    Row<L> stiff = Row<L>(run.spring) * (h * h), loss = Row<L>(run.damper) * h;
    return (loss > 0.0) & (1.0 + loss < SLOWEST_SWING * stiff);
}

// Integral of c q'^2 over h seconds for modes with free waves, `waves` at its end [J].
//
// q' is a polynomial y'(t) and the rate of a free motion u. The latter alone dissipates c int u'^2,
// the decrease of (u'^2 + w^2 u^2)/2; int t^k u' and int t^k u follow from each other by u'' + c u'
// + w^2 u = 0.
template <int L>
ALWAYS_INLINE Row<L> damped(const Propagation& run, double h, const double* cosine,
                            const double* sine) {
    using V = Row<L>;
    const ModalMotion& motion = run.motion;
    const double step = motion.step, part = h / step, per_step = 1.0 / step;
    V c(motion.damping), square(motion.square), first(cosine), second(sine);
    V u0(motion.free[0]), w0(motion.free[1]);
    V u1 = first * u0 + second * w0, w1 = (first - c * second) * w0 - square * second * u0;
    V lost = 0.5 * (w0 * w0 - w1 * w1 + square * (u0 * u0 - u1 * u1));
    // y' = (a + b s + d s^2 + e s^3)/h with s = t/h, from 0 to `part`
    const double (*y)[BODIES] = motion.particular;
    V a(y[1]), b = 2.0 * V(y[2]), d = 3.0 * V(y[3]), e = 4.0 * V(y[4]);
    V inverse = 1.0 / larger(square * step, V(SMALLEST));
    V rate0 = u1 - u0;  // integral of u', then of s^k u', and of s^k u over h
    V value0 = (w0 - w1 - c * rate0) * inverse;
    V rate1 = part * u1 - value0;
    V value1 = (rate0 * per_step - part * w1 - c * rate1) * inverse;
    V rate2 = part * part * u1 - 2.0 * value1;
    V value2 = (2.0 * per_step * rate1 - part * part * w1 - c * rate2) * inverse;
    V rate3 = part * part * part * u1 - 3.0 * value2;
    V cross = a * rate0 + b * rate1 + d * rate2 + e * rate3;
    V five = part * (d * e * (1.0 / 3.0) + part / 7.0 * e * e);
    V four = part * ((d * d + 2.0 * b * e) * 0.2 + five);
    V three = part * (0.5 * (a * e + b * d) + four);
    V two = part * ((b * b + 2.0 * a * d) * (1.0 / 3.0) + three);
    V own = a * a + part * (a * b + two);
    return lost + c * (2.0 * cross + own * part) * per_step;
}

// Sum of a row over all meshes and their copies.
template <int L>
ALWAYS_INLINE double sum_of_meshes(const Train& train, const Row<L>& row) {
    return total(Row<L>(train.copies) * row);
}

// Fill the ledger h seconds after the start of the step, by quadrature at the nodes; the
// dissipation of modes with free waves is known exactly.
template <int L>
void integrate_powers(const Train& train, Integrator& integrator, double h) {
    using V = Row<L>;
    Propagation& run = integrator.run;
    State& end = integrator.end;
    const std::int64_t last = run.nodes.count - 1;
    const double t = h / run.motion.step;
    for (int e = 0; e < LEDGER; ++e) end.energy[e] = integrator.begin.energy[e];
    weigh_nodes(run, t);
    using OfMeshes = Row<MESH_LANES<L>>;
    V quadrature(0.0);
    OfMeshes lost(0.0), work(0.0), friction(0.0);
    for (std::int64_t n = 0; n <= last; ++n) {
        const double weight = run.weight[n];
        const Node& node = run.node[n];
        for (int e = 0; e < LEDGER; ++e) end.energy[e] += weight * node.power[e];
        V rate(node.p);
        quadrature += weight * rate * rate;
        lost += weight * OfMeshes(node.meshes.lost);
        work += weight * OfMeshes(node.meshes.work);
        friction += weight * OfMeshes(node.friction.drag.power);
    }
    end.energy[DAMPING] += sum_of_meshes(train, lost);
    end.energy[STIFFNESS_WORK] += sum_of_meshes(train, work);
    if (train.friction) end.energy[FRICTION] += sum_of_meshes(train, friction);
    V exact = damped<L>(run, h, run.end_cosine, run.end_sine) - V(run.motion.damping) * quadrature;
    end.energy[DAMPING] += total(select(swings<L>(run), exact, 0.0));
}

}  // namespace gearbox
