#pragma once

// Stiffness of a mesh and of its tooth pairs, from the tables of the train.

#include <bit>

#include "capacities.hpp"
#include "model/step_constants.hpp"
#include "model/train.hpp"

namespace gearbox {

struct ValueAndSlope {
    double value, slope;  // slope per mesh cycle
};

// A polynomial and its derivative at u.
inline ValueAndSlope polynomial(const double* coefficient, double u, std::int64_t terms) {
    double value = 0.0, slope = 0.0;
    for (std::int64_t n = terms - 1; n >= 0; --n) {
        slope = slope * u + value;
        value = value * u + coefficient[n];
    }
    return {value, slope};
}

// Sum of the weights of the tooth pairs of a mesh `u` cycles into a segment.
inline ValueAndSlope total_weight(const Train& train, std::int64_t kind, std::int64_t segment,
                                  double u) {
    return polynomial(train.teeth.weight[kind][segment][TOTAL], u, train.teeth.terms);
}

// Stiffness [N/m] of mesh i without faults at a fraction of its cycle.
inline double mesh_stiffness(const Train& train, std::int64_t i, std::int64_t segment,
                             double cycle) {
    const std::int64_t kind = train.mesh.kind[i];
    double total =
        total_weight(train, kind, segment, cycle - train.teeth.edge[kind][segment]).value;
    return train.mesh.stiffness_factor[i] *
           (train.teeth.stiffness_base[kind] + train.teeth.stiffness_gain[kind] * total);
}

struct FaultEffect {
    double factor, growth, gap;  // on the stiffness, per cycle, missing material [m]
};

// Effect of the faults of a tooth pair.
inline FaultEffect fault_effect(const Train& train, const StepConstants& step, std::int64_t i,
                                std::int64_t segment, std::int64_t pair, double u) {
    const Faults& faults = train.faults;
    FaultEffect effect{1.0, 0.0, step.gap[i][pair]};
    for (std::uint64_t left = step.faulty[i][pair]; left != 0; left &= left - 1) {
        const std::int64_t first = faults.first_factor[std::countr_zero(left)][train.mesh.kind[i]];
        auto [value, slope] =
            polynomial(faults.factor[first + segment * faults.pairs + pair], u, TERMS);
        effect.growth = effect.growth * value + effect.factor * slope;
        effect.factor *= value;
    }
    return effect;
}

struct StiffnessAndGap {
    double stiffness, gap;  // [N/m], missing material [m]
};

// Stiffness of a tooth pair `u` cycles into a segment, with its faults.
inline StiffnessAndGap pair_stiffness(const Train& train, const StepConstants& step, std::int64_t i,
                                      std::int64_t segment, std::int64_t pair, double u) {
    std::int64_t kind = train.mesh.kind[i];
    double total = total_weight(train, kind, segment, u).value;
    double per_weight = train.teeth.stiffness_base[kind] / total + train.teeth.stiffness_gain[kind];
    double weight = polynomial(train.teeth.weight[kind][segment][pair], u, train.teeth.terms).value;
    FaultEffect effect = fault_effect(train, step, i, segment, pair, u);
    return {train.mesh.stiffness_factor[i] * per_weight * weight * effect.factor, effect.gap};
}

}  // namespace gearbox
