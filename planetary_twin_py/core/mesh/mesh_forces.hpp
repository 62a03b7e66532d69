#pragma once

// Forces of the meshes, and the shares of their tooth pairs.
//
// A closed mesh is squeezed by q = d - e - b on its side, d the transmission error, e the error of
// form, b half the backlash. A pair of stiffness k has the force k (q + tau q'), Salagianni et al.
// 2017, (4), (5), (14), along the line of action; a worn pair carries only where q exceeds its
// missing material.

#include "mesh/cycle.hpp"
#include "mesh/damping.hpp"
#include "mesh/deflection.hpp"
#include "mesh/slope.hpp"
#include "mesh/stiffness.hpp"
#include "model/evaluation.hpp"
#include "model/model.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Subtract the errors of form.
COLD inline void place_errors(const Train& train, const StepConstants& step, MeshesNow& now) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        LengthAndRate e =
            form_error(train, i, step.side[i], step.line_angle, now.advance, now.cycle_rate);
        now.d[i] -= e.length;
        now.rate[i] -= e.rate;
        now.error_rate[i] = e.rate;
    }
}

// Positions of the meshes `delay` seconds after the start of a step, with errors of form.
inline void place_meshes(const Train& train, const State& state, const StepConstants& step,
                         const double* x, const double* v, double delay, MeshesNow& now) {
    now.advance = step.cycle_rate * delay + cycle_shift(train, x) - cycle_shift(train, state.x);
    now.cycle_rate = step.cycle_rate + cycle_shift(train, v);
    now.speed_damping_time = train.damping.cycles /
                             at_least(passing_rate(train, step, v), train.damping.lowest_frequency);
    if (train.errors.lines[0] + train.errors.lines[1] > 0) place_errors(train, step, now);
}

// Position of each mesh in its segment [cycles].
template <int L>
ALWAYS_INLINE Row<L> place_in_segment(const StepConstants& step, double advance) {
    using V = Row<L>;
    return V(step.start) - V(step.low) + V(step.side) * advance;
}

// Weights of a tooth pair of each mesh, and their growth per cycle.
template <int L>
struct Weights {
    Row<L> value, growth;
};

// Weights from their polynomials, `u` cycles into the segments.
template <int L>
ALWAYS_INLINE Weights<L> weigh(std::int64_t terms, const double (*coefficient)[MESHES],
                               const Row<L>& u) {
    using V = Row<L>;
    if (terms == 2)  // for a given stiffness
        return {V(coefficient[0]) + V(coefficient[1]) * u, V(coefficient[1])};
    V value(coefficient[terms - 1]), growth(0.0);
    for (std::int64_t t = terms - 2; t >= 0; --t) {
        growth = growth * u + value;
        value = value * u + V(coefficient[t]);
    }
    return {value, growth};
}

// Add the power lost to damping, and that of changing stiffness and errors of form.
inline void add_mesh_power(const Train& train, const MeshesNow& now, double* power) {
    double lost = 0.0, work = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        lost += train.mesh.copies[i] * now.damping_power[i];
        work += train.mesh.copies[i] * now.stiffness_power[i];
    }
    power[DAMPING] += lost;
    power[STIFFNESS_WORK] += work;
}

// Set normal force, damping and stiffness power of each mesh at its position; healthy teeth only.
template <int L>
ALWAYS_INLINE void healthy_mesh_forces(const Model& model, const StepConstants& step,
                                       MeshesNow& now) {
    using V = Row<L>;
    const double offset = model.operation.backlash.offset,
                 inner_squared = model.operation.backlash.inner_squared;
    V u = place_in_segment<L>(step, now.advance);
    auto [weight, growth] = weigh<L>(model.train.teeth.terms, step.weight[TOTAL], u);
    V side(step.side), closed = absolute(side), gain(step.gain);
    V k = closed * (V(step.base) + gain * weight);
    V deflection = side * V(now.d) - offset, closing = side * V(now.rate);
    V damped = k * (V(step.fixed_damping_time) + now.speed_damping_time) * closing;
    V normal_force = k * deflection + damped;
    V work = 0.5 * closed * gain * growth;
    work *= (deflection * deflection - inner_squared) * now.cycle_rate;
    normal_force.store(now.normal_force);
    if constexpr (MOVING) {
        k.store(now.stiffness);
        (side * gain * growth * now.cycle_rate).store(now.stiffening);
    }
    (damped * closing).store(now.damping_power);
    (side * (work - normal_force * V(now.error_rate))).store(now.stiffness_power);
}

// Distribute the forces to the tooth pairs by their stiffnesses.
template <int L>
ALWAYS_INLINE void spread_loads(const Train& train, const StepConstants& step, MeshesNow& now) {
    using V = Row<L>;
    V u = place_in_segment<L>(step, now.advance), normal_force(now.normal_force);
    V inverse = 1.0 / weigh<L>(train.teeth.terms, step.weight[TOTAL], u).value;
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        V share = weigh<L>(train.teeth.terms, step.weight[p], u).value * inverse;
        share.store(now.share[p]);
        larger(share * normal_force, V(0.0)).store(now.load[p]);
    }
}

// Radii of both flanks of a tooth pair of each mesh [m].
template <int L>
struct Radii {
    Row<L> first, second;
};

// Radii of pair p, whose teeth are at `moved` [m] on the path of contact, counted from cycle 0.
template <int L>
ALWAYS_INLINE Radii<L> flank_radii(const StepConstants& step, std::int64_t p, const Row<L>& moved) {
    Row<L> path = Row<L>(step.travel[p]) * moved;
    return {Row<L>(step.rho1[p]) + path, Row<L>(step.rho2[p]) - Row<L>(step.external) * path};
}

// Distance of the contacts along their path from cycle 0 [m].
template <int L>
ALWAYS_INLINE Row<L> path_position(const Train& train, const StepConstants& step, double advance) {
    const double pitch = train.geometry.base_pitch;
    return Row<L>(step.side) * (advance * pitch) + Row<L>(step.start) * pitch;
}

// Part of the face on which pair p is in contact; negligible parts count as none.
template <int L>
ALWAYS_INLINE Row<L> face_in_contact(const StepConstants& step, std::int64_t p, double advance) {
    constexpr double LEAST = 1e-3;
    Row<L> cycle = Row<L>(step.side) * advance + Row<L>(step.start);
    return larger(Row<L>(step.face[p]) + Row<L>(step.face_growth[p]) * cycle, Row<L>(LEAST));
}

// Write loads and radii of the tooth pairs of all meshes to columns.
template <int L>
inline void fill_pairs(const Train& train, const StepConstants& step, const MeshesNow& now,
                       ToothPairs& pairs) {
    Row<L> moved = path_position<L>(train, step, now.advance);
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        std::int64_t first =
            p * train.meshes;  // the next pair overwrites entries beyond the meshes
        auto [rho1, rho2] = flank_radii<L>(step, p, moved);
        rho1.store(pairs.rho1 + first);
        rho2.store(pairs.rho2 + first);
        copy<L>(now.share[p], pairs.share + first);
        copy<L>(now.load[p], pairs.load + first);
        face_in_contact<L>(step, p, now.advance).store(pairs.face + first);
        copy<L>(step.external, pairs.external + first);
    }
    pairs.count = train.teeth.slots * train.meshes;
}

// Force of mesh i from its tooth pairs, each of which may have faults.
inline void faulty_mesh_force(const Model& model, const State& state, const StepConstants& step,
                              std::int64_t i, MeshesNow& now) {
    const Train& train = model.train;
    const std::int64_t kind = train.mesh.kind[i], segment = state.segment[i];
    now.normal_force[i] = now.damping_power[i] = now.stiffness_power[i] = now.stiffness[i] =
        now.stiffening[i] = 0.0;
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) now.load[p][i] = 0.0;
    if (state.side[i] == OPEN) return;
    double side = static_cast<double>(state.side[i]);
    double u = step.start[i] - step.low[i] + side * now.advance;
    double deflection = side * now.d[i] - model.operation.backlash.offset,
           closing = side * now.rate[i];
    auto [total, fading] = total_weight(train, kind, segment, u);
    double tau = step.fixed_damping_time[i] + now.speed_damping_time,
           per_weight = step.base[i] / total + step.gain[i];
    double falling = -step.base[i] * fading / (total * total), work = 0.0;
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        FaultEffect effect = fault_effect(train, step, i, segment, p, u);
        auto [weight, growth] =
            polynomial(train.teeth.weight[kind][segment][p], u, train.teeth.terms);
        double k = per_weight * weight * effect.factor;
        double dk = (per_weight * growth + falling * weight) * effect.factor +
                    per_weight * weight * effect.growth;
        double q = deflection - effect.gap;
        if (effect.gap > 0.0 && q < 0.0) k = dk = 0.0;
        double force = k * (q + tau * closing);
        if (effect.gap > 0.0) force = at_least(force, 0.0);
        now.normal_force[i] += force;
        now.stiffness[i] += k;
        now.stiffening[i] += side * dk * now.cycle_rate;
        now.damping_power[i] += (force - k * q) * closing;
        work += 0.5 * dk * (q * q - model.operation.backlash.inner_squared);
        now.load[p][i] = at_least(force, 0.0);
    }
    now.stiffness_power[i] =
        side * (work * now.cycle_rate - now.normal_force[i] * now.error_rate[i]);
}

// The same as `healthy_mesh_forces` and `spread_loads`, pair by pair.
template <int L>
COLD void faulty_mesh_forces(const Model& model, const State& state, const StepConstants& step,
                             MeshesNow& now) {
    spread_loads<L>(model.train, step, now);
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        faulty_mesh_force(model, state, step, i, now);
}

// Forces of the meshes, whose transmission errors are in `now`.
template <int L>
ALWAYS_INLINE void find_mesh_forces(const Model& model, const State& state,
                                    const StepConstants& step, MeshesNow& now) {
    if (model.train.faults.count > 0)
        faulty_mesh_forces<L>(model, state, step, now);
    else
        healthy_mesh_forces<L>(model, step, now);
}

// Distribute the forces to the tooth pairs where that is not done yet.
template <int L>
NOINLINE void distribute_forces(const Train& train, const StepConstants& step, MeshesNow& now) {
    if (train.faults.count == 0) spread_loads<L>(train, step, now);
}

// Forces of the meshes, whose transmission errors are in out.now; initialises out.power.
inline void mesh_forces(const Model& model, const State& state, const StepConstants& step,
                        const double* x, const double* v, double delay, Evaluation& out) {
    for (double& power : out.power) power = 0.0;
    place_meshes(model.train, state, step, x, v, delay, out.now);
    with_mesh_lanes(model.train,
                    [&](auto lanes) { find_mesh_forces<lanes>(model, state, step, out.now); });
    if (tilts(model.train)) tilt_flanks(model.train, step, x, v, out.now);
    add_mesh_power(model.train, out.now, out.power);
}

// Distribute the forces to the tooth pairs, in columns.
inline void share_loads(const Model& model, const StepConstants& step, Evaluation& out) {
    with_mesh_lanes(model.train, [&](auto lanes) {
        distribute_forces<lanes>(model.train, step, out.now);
        fill_pairs<lanes>(model.train, step, out.now, out.pairs);
    });
}

// Rate of change [N/s] of the force of closed mesh i with its cycle, with its bodies at rest in x.
inline double force_time_derivative(const Model& model, const State& state,
                                    const StepConstants& step, std::int64_t i, double cycle_rate) {
    const Train& train = model.train;
    std::int64_t kind = train.mesh.kind[i];
    double side = static_cast<double>(state.side[i]);
    double tau = step.tau[kind], u = step.start[i] - step.low[i];
    auto [d, rate, error_rate] = deflection(train, step, i, state.x, state.v, 0.0, cycle_rate);
    auto [total, growth] = total_weight(train, kind, state.segment[i], u);
    double normal_force = side * d - model.operation.backlash.offset + tau * side * rate;
    double derivative = step.gain[i] * growth * side * cycle_rate * normal_force;
    if (train.errors.lines[kind] > 0) {
        double k = step.base[i] + step.gain[i] * total;
        double acceleration =
            form_error_acceleration(train, i, step.side[i], step.line_angle, cycle_rate);
        derivative -= k * side * (error_rate + tau * acceleration);
    }
    return derivative;
}

}  // namespace gearbox
