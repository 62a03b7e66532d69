#pragma once

// The forces of the meshes, and how their tooth pairs share them.
//
// A closed mesh is squeezed by q = d - e - b on its side, d the transmission error, e the error of
// form, b half the backlash. A pair of stiffness k pushes with k (q + tau q'), Salagianni et al.
// 2017, (4), (5), (14) along the line of action; a worn pair only when q has passed its missing
// material.

#include <cmath>

#include "mesh/cycle.hpp"
#include "mesh/damping.hpp"
#include "mesh/deflection.hpp"
#include "mesh/stiffness.hpp"
#include "train/evaluation.hpp"
#include "train/model.hpp"

namespace gearbox {

// Where the meshes stand `delay` seconds after the start of a step, errors of form counted.
inline void place_meshes(const Train& train, const State& state, const StepConstants& step,
                         const double* x, const double* v, double delay, MeshesNow& now) {
    now.advance = step.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x);
    now.pace = step.cycle_rate + cycle_shift(train, v);
    now.following =
        train.damping_cycles / at_least(passing_rate(train, step, v), train.lowest_frequency);
    if (train.lines[0] + train.lines[1] == 0) return;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        LengthAndRate e =
            form_error(train, i, step.side[i], step.line_angle, now.advance, now.pace);
        now.d[i] -= e.length;
        now.rate[i] -= e.rate;
        now.error_rate[i] = e.rate;
    }
}

// Weights of one tooth pair of all meshes (of all pairs for TOTAL), and their growth.
template <int L>
inline void weigh(std::int64_t terms, const StepConstants& step, MeshesNow& now, int pair) {
    const double advance = now.advance;
    const auto& coefficient = step.weight[pair];
    double *weight = now.weight[pair], *growth = now.growth[pair];
    if (terms == 2) {  // what a given stiffness needs
        for (int i = 0; i < L; ++i) {
            double u = step.start[i] - step.low[i] + step.side[i] * advance;
            weight[i] = coefficient[0][i] + coefficient[1][i] * u;
            growth[i] = coefficient[1][i];
        }
        return;
    }
    for (int i = 0; i < L; ++i) {
        weight[i] = coefficient[terms - 1][i];
        growth[i] = 0.0;
    }
    for (std::int64_t t = terms - 2; t >= 0; --t) {
        for (int i = 0; i < L; ++i) {
            double u = step.start[i] - step.low[i] + step.side[i] * advance;
            growth[i] = growth[i] * u + weight[i];
            weight[i] = weight[i] * u + coefficient[t][i];
        }
    }
}

// Book what the meshes lose to damping, and what their changing shape puts in.
inline void book_mesh_power(const Train& train, const MeshesNow& now, double* power) {
    double lost = 0.0, work = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        lost += train.copies[i] * now.lost[i];
        work += train.copies[i] * now.work[i];
    }
    power[DAMPING] = lost;
    power[STIFFNESS_WORK] = work;
}

// Pushes of all meshes without faults from where they stand, and their powers.
template <int L>
inline void healthy_mesh_forces(const Model& model, const StepConstants& step, MeshesNow& now,
                                double* power) {
    const double pace = now.pace, following = now.following;
    const double offset = model.load.offset, inner_squared = model.load.inner_squared;
    weigh<L>(model.train.terms, step, now, TOTAL);
    for (int i = 0; i < L; ++i) {
        double side = step.side[i], closed = std::abs(side);
        double k = closed * (step.base[i] + step.gain[i] * now.weight[TOTAL][i]);
        double squeeze = side * now.d[i] - offset, closing = side * now.rate[i];
        double damped = k * (step.fixed[i] + following) * closing;
        double push = k * squeeze + damped;
        double work = 0.5 * closed * step.gain[i] * now.growth[TOTAL][i];
        work *= (squeeze * squeeze - inner_squared) * pace;
        now.push[i] = push;
        now.lost[i] = damped * closing;
        now.work[i] = side * (work - push * now.error_rate[i]);
    }
    book_mesh_power(model.train, now, power);
}

// Loads and radii of the tooth pairs of all meshes.
template <int L>
inline void spread_loads(const Train& train, const StepConstants& step, MeshesNow& now,
                         ToothPairs& pairs) {
    const double pitch = train.base_pitch, passed = now.advance * pitch;
    for (int i = 0; i < L; ++i) now.inverse[i] = 1.0 / now.weight[TOTAL][i];
    for (int p = 0; p < train.slots; ++p) {
        weigh<L>(train.terms, step, now, p);
        std::int64_t first = p * train.meshes;  // the next pair overwrites what is beyond meshes
        for (int i = 0; i < L; ++i) {
            double share = now.weight[p][i] * now.inverse[i];
            pairs.share[first + i] = share;
            pairs.load[first + i] = at_least(share * now.push[i], 0.0);
        }
        for (int i = 0; i < L; ++i) {
            double s = step.side[i] * passed + step.start[i] * pitch;
            pairs.rho1[first + i] = step.rho1[p][i] + s;
            pairs.rho2[first + i] = step.rho2[p][i] - step.external[i] * s;
            pairs.external[first + i] = step.external[i];
        }
    }
    pairs.count = train.slots * train.meshes;
}

// Push of mesh i from its tooth pairs, each of which may have its faults.
inline void faulty_mesh_force(const Model& model, const State& state, const StepConstants& step,
                              std::int64_t i, MeshesNow& now, ToothPairs& pairs) {
    const Train& train = model.train;
    now.push[i] = now.lost[i] = now.work[i] = 0.0;
    if (state.side[i] == OPEN) return;
    double side = static_cast<double>(state.side[i]);
    double u = step.start[i] - step.low[i] + side * now.advance;
    double squeeze = side * now.d[i] - model.load.offset, closing = side * now.rate[i];
    double tau = step.fixed[i] + now.following, total = now.weight[TOTAL][i];
    double per_weight = step.base[i] / total + step.gain[i];
    double falling = -step.base[i] * now.growth[TOTAL][i] / (total * total);
    double work = 0.0;
    for (std::int64_t p = 0; p < train.slots; ++p) {
        FaultEffect effect = fault_effect(train, step, i, state.segment[i], p, u);
        double weight = now.weight[p][i];
        double k = per_weight * weight * effect.factor;
        double dk = (per_weight * now.growth[p][i] + falling * weight) * effect.factor +
                    per_weight * weight * effect.growth;
        double q = squeeze - effect.gap;
        if (effect.gap > 0.0 && q < 0.0) k = dk = 0.0;
        double force = k * (q + tau * closing);
        if (effect.gap > 0.0) force = at_least(force, 0.0);
        now.push[i] += force;
        now.lost[i] += (force - k * q) * closing;
        work += 0.5 * dk * (q * q - model.load.inner_squared);
        pairs.load[p * train.meshes + i] = at_least(force, 0.0);
    }
    now.work[i] = side * (work * now.pace - now.push[i] * now.error_rate[i]);
}

// The same as `healthy_mesh_forces` and `spread_loads`, pair by pair.
template <int L>
inline void faulty_mesh_forces(const Model& model, const State& state, const StepConstants& step,
                               MeshesNow& now, ToothPairs& pairs, double* power) {
    weigh<L>(model.train.terms, step, now, TOTAL);
    spread_loads<L>(model.train, step, now, pairs);
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        faulty_mesh_force(model, state, step, i, now, pairs);
    book_mesh_power(model.train, now, power);
}

// Pushes of the meshes, whose transmission errors are in out.now; begins out.power.
template <int L>
inline void mesh_forces(const Model& model, const State& state, const StepConstants& step,
                        const double* x, const double* v, double delay, Evaluation& out) {
    for (double& power : out.power) power = 0.0;
    place_meshes(model.train, state, step, x, v, delay, out.now);
    if (model.train.faults > 0)
        faulty_mesh_forces<L>(model, state, step, out.now, out.pairs, out.power);
    else
        healthy_mesh_forces<L>(model, step, out.now, out.power);
}

// Share the pushes among the tooth pairs, where that is not done yet.
template <int L>
inline void share_loads(const Model& model, const StepConstants& step, Evaluation& out) {
    if (model.train.faults == 0) spread_loads<L>(model.train, step, out.now, out.pairs);
}

// Whether all bodies and meshes fit into the fewer lanes.
constexpr int FEW_LANES = MESHES / 2;
inline bool few(const Train& train) {
    return train.lanes <= FEW_LANES;
}

inline void mesh_forces(const Model& model, const State& state, const StepConstants& step,
                        const double* x, const double* v, double delay, Evaluation& out) {
    if (few(model.train))
        mesh_forces<FEW_LANES>(model, state, step, x, v, delay, out);
    else
        mesh_forces<MESHES>(model, state, step, x, v, delay, out);
}

inline void share_loads(const Model& model, const StepConstants& step, Evaluation& out) {
    if (few(model.train))
        share_loads<FEW_LANES>(model, step, out);
    else
        share_loads<MESHES>(model, step, out);
}

// Growth [N/s] of the push of closed mesh i with its cycle, were its bodies to rest in x.
inline double push_drift(const Model& model, const State& state, const StepConstants& step,
                         std::int64_t i, double pace) {
    const Train& train = model.train;
    std::int64_t kind = train.kind[i];
    double side = static_cast<double>(state.side[i]);
    double tau = step.tau[kind], u = step.start[i] - step.low[i];
    auto [d, rate, error_rate] = deflection(train, step, i, state.x, state.v, 0.0, pace);
    auto [total, growth] = total_weight(train, kind, state.segment[i], u);
    double push = side * d - model.load.offset + tau * side * rate;
    double drift = train.stiffness_gain[kind] * growth * side * pace * push;
    if (train.lines[kind] > 0) {
        double k = train.stiffness_base[kind] + train.stiffness_gain[kind] * total;
        double bend = form_error_bend(train, i, step.side[i], step.line_angle, pace);
        drift -= k * side * (error_rate + tau * bend);
    }
    return drift;
}

}  // namespace gearbox
