#pragma once

// Quantities of the meshes at one instant that are published and recorded.

#include <cmath>
#include <limits>

#include "lubrication/tooth_friction.hpp"
#include "mesh/mesh_forces.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Fill out[:, i] for every mesh i; film and lambda ratio are NaN without contact.
//
// Both are means over the tooth pairs, weighted by load. Friction forces are magnitudes. `work` is
// work space; out (QUANTITIES, meshes) has rows of `room` entries. Without `films`, their
// quantities are zero.
inline void observe(const Model& model, const State& state, const StepConstants& step,
                    const double* x, const double* v, double delay, Evaluation& work, double* out,
                    std::int64_t room, bool films = true) {
    const Train& train = model.train;
    const Oil& oil = model.oil;
    const MeshesNow& now = work.now;
    ToothPairs& pairs = work.pairs;
    auto at = [=](int row, std::int64_t i) -> double& { return out[row * room + i]; };
    for (int row = 0; row < QUANTITIES; ++row)
        for (std::int64_t i = 0; i < train.meshes; ++i) at(row, i) = 0.0;
    move_meshes(train, x, v, work.now);
    mesh_forces(model, state, step, x, v, delay, work);
    share_loads(model, step, work);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double force = at_least(now.normal_force[i], 0.0);
        at(DTE, i) = mesh_motion(train, i, x);
        at(MESH_FORCE, i) = static_cast<double>(state.side[i]) * force;
        at(MESH_POWER, i) = force * train.base_pitch * std::abs(now.cycle_rate);
        if (state.side[i] == OPEN)
            at(FILM, i) = at(LAMBDA, i) = std::numeric_limits<double>::quiet_NaN();
    }
    turn_pairs(train, step, v, pairs);
    evaluate(model, pairs);
    for (std::int64_t p = 0; p < train.slots; ++p) {
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            std::int64_t k = p * train.meshes + i;
            if (films) {
                at(FILM, i) += pairs.share[k] * at_least(exp(pairs.log_film[k]), THINNEST_FILM);
                at(LAMBDA, i) += pairs.share[k] * lambda_ratio_of(oil, pairs.log_film[k]);
            }
            if (!train.friction) continue;
            at(BOUNDARY, i) += pairs.boundary[k];
            at(VISCOUS, i) += pairs.viscous[k];
            at(POWER_LOSS, i) += dissipated(pairs, k) + pairs.rolling_power[k];
        }
    }
}

inline void observe(const Model& model, const State& state, const StepConstants& step,
                    const double* x, const double* v, double delay, Evaluation& work,
                    double (*out)[MESHES], bool films = true) {
    observe(model, state, step, x, v, delay, work, &out[0][0], MESHES, films);
}

}  // namespace gearbox
