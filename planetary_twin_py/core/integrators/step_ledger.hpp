#pragma once

// The energy ledger of a step by collocation.

#include "integrators/propagation.hpp"

namespace gearbox {

inline constexpr double SLOWEST_SWING = 30.0;  // (1 + c h)/(w h)^2, to whose 4th power digits are lost

// Weight of node n in the integral over the part t of the step [s].
inline double node_weight(const Propagation& run, std::int64_t n, double t) {
    double weight = 0.0, u = run.motion.step;
    for (std::int64_t k = 0; k < run.nodes.count; ++k) {
        u *= t;
        weight += run.nodes.coefficient[k][n] * u / static_cast<double>(k + 1);
    }
    return weight;
}

// Whether a mode has free waves, of which quadrature might miss what is damped. Not those that
// hardly move within the step: `damped_by_waves` would lose all its digits, quadrature none.
inline bool swings(const Propagation& run, int m) {
    double h = run.motion.step, stiff = run.spring[m] * h * h, loss = run.damper[m] * h;
    return loss > 0.0 && 1.0 + loss < SLOWEST_SWING * stiff;
}

// Integral of c q'^2 over h seconds for a mode that swings, with `wave` at its end [J].
//
// q' is a polynomial y'(t) and the rate of a free motion u. By itself that loses c int u'^2, the
// energy (u'^2 + w^2 u^2)/2 it has less at the end; int t^k u' and int t^k u follow from each other
// by u'' + c u' + w^2 u = 0.
inline double damped(const Propagation& run, int m, double h, double first, double second) {
    const ModalMotion& motion = run.motion;
    double c = motion.damping[m], square = motion.square[m], step = motion.step, part = h / step;
    double u0 = motion.free[0][m], w0 = motion.free[1][m];
    double u1 = first * u0 + second * w0, w1 = (first - c * second) * w0 - square * second * u0;
    double lost = 0.5 * (w0 * w0 - w1 * w1 + square * (u0 * u0 - u1 * u1));
    // y' = (a + b s + d s^2 + e s^3)/h with s = t/h, from 0 to `part`
    const double(*y)[BODIES] = motion.particular;
    double a = y[1][m], b = 2.0 * y[2][m], d = 3.0 * y[3][m], e = 4.0 * y[4][m];
    double inverse = 1.0 / std::max(square * step, SMALLEST);
    double rate0 = u1 - u0;  // integral of u', then of s^k u', and of s^k u over h
    double value0 = -(w1 - w0 + c * rate0) * inverse;
    double rate1 = part * u1 - value0;
    double value1 = -(part * w1 - rate0 / step + c * rate1) * inverse;
    double rate2 = part * part * u1 - 2.0 * value1;
    double value2 = -(part * part * w1 - 2.0 * rate1 / step + c * rate2) * inverse;
    double rate3 = part * part * part * u1 - 3.0 * value2;
    double cross = a * rate0 + b * rate1 + d * rate2 + e * rate3;
    double five = part * (d * e / 3.0 + part * e * e / 7.0);
    double four = part * ((d * d + 2.0 * b * e) / 5.0 + five);
    double three = part * (0.5 * (a * e + b * d) + four);
    double two = part * ((b * b + 2.0 * a * d) / 3.0 + three);
    double own = a * a + part * (a * b + two);
    return lost + c * (2.0 * cross + own * part) / step;
}

// Fill the ledger at h seconds into the step: by quadrature at the nodes; what damping takes from
// modes that swing is known exactly.
template <int L>
void integrate_powers(March& march, double h) {
    Propagation& run = march.run;
    State& end = march.end;
    const std::int64_t last = run.nodes.count - 1;
    double t = h / run.motion.step, waves_lose[L], lost = 0.0;
    for (int e = 0; e < LEDGER; ++e) end.energy[e] = march.begin.energy[e];
    double quadrature[L] = {};
    for (std::int64_t n = 0; n <= last; ++n) {
        double weight = node_weight(run, n, t);
        for (int e = 0; e < LEDGER; ++e) end.energy[e] += weight * run.evaluation[n].power[e];
        for (int m = 0; m < L; ++m)
            quadrature[m] += weight * run.motion.damping[m] * run.node_p[n][m] * run.node_p[n][m];
    }
    double cosine[L], sine[L];
    if (h == run.motion.step) {
        copy<L>(run.cosine[last], cosine);
        copy<L>(run.sine[last], sine);
    } else {
        waves<L>(run.motion, h, cosine, sine);
    }
    for (int m = 0; m < L; ++m) {
        double exact = damped(run, m, h, cosine[m], sine[m]);
        waves_lose[m] = swings(run, m) ? exact - quadrature[m] : 0.0;
    }
    for (int m = 0; m < L; ++m) lost += waves_lose[m];
    end.energy[DAMPING] += lost;
}

}  // namespace gearbox
