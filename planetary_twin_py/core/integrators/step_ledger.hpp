#pragma once

// The energy ledger of a step by collocation.

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SLOWEST_SWING =
    30.0;  // (1 + c h)/(w h)^2, to whose 4th power digits are lost

// Weight of node n in the integral over the part t of the step [s].
inline double node_weight(const Propagation& run, std::int64_t n, double t) {
    double weight = 0.0, u = run.motion.step;
    for (std::int64_t k = 0; k < run.nodes.count; ++k) {
        u *= t;
        weight += run.nodes.coefficient[k][n] * u / static_cast<double>(k + 1);
    }
    return weight;
}

// Which modes have free waves, of which quadrature might miss what is damped. Not those that hardly
// move within the step: `damped` would lose all its digits, quadrature none.
template <int L>
LAW Mask<L> swings(const Propagation& run) {
    const double h = run.motion.step;
    Row<L> stiff = Row<L>(run.spring) * (h * h), loss = Row<L>(run.damper) * h;
    return (loss > 0.0) & (1.0 + loss < SLOWEST_SWING * stiff);
}

// Integral of c q'^2 over h seconds for modes that swing, with `waves` at its end [J].
//
// q' is a polynomial y'(t) and the rate of a free motion u. By itself that loses c int u'^2, the
// energy (u'^2 + w^2 u^2)/2 it has less at the end; int t^k u' and int t^k u follow from each other
// by u'' + c u' + w^2 u = 0.
template <int L>
LAW Row<L> damped(const Propagation& run, double h, const double* cosine, const double* sine) {
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

// Fill the ledger at h seconds into the step: by quadrature at the nodes; what damping takes from
// modes that swing is known exactly.
template <int L>
void integrate_powers(March& march, double h) {
    using V = Row<L>;
    Propagation& run = march.run;
    State& end = march.end;
    const std::int64_t last = run.nodes.count - 1;
    const double t = h / run.motion.step;
    for (int e = 0; e < LEDGER; ++e) end.energy[e] = march.begin.energy[e];
    V quadrature(0.0);
    for (std::int64_t n = 0; n <= last; ++n) {
        double weight = run.weight[n] = node_weight(run, n, t);
        for (int e = 0; e < LEDGER; ++e) end.energy[e] += weight * run.evaluation[n].power[e];
        V rate(run.node_p[n]);
        quadrature += weight * rate * rate;
    }
    V exact = damped<L>(run, h, run.end_cosine, run.end_sine) - V(run.motion.damping) * quadrature;
    end.energy[DAMPING] += total(select(swings<L>(run), exact, 0.0));
}

}  // namespace gearbox
