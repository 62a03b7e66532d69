#pragma once

// Integrals over a step of what its tooth pairs show: films and friction, side by side.

#include <algorithm>
#include <cmath>

#include "integrators/contact_sums_record.hpp"
#include "mesh/mesh_forces.hpp"
#include "train/model.hpp"
#include "train/step_constants.hpp"
#include "tribology/tooth_friction.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Pairs in whole registers.
inline std::int64_t width_of_pairs(const Train& train) {
    return (train.slots * train.meshes + REGISTER - 1) / REGISTER * REGISTER;
}

inline void clear_contacts(const Train& train, ContactSums& sums) {
    for (std::int64_t k = 0; k < width_of_pairs(train); ++k) {
        sums.share[k] = sums.film[k] = 0.0;
        sums.boundary[k] = sums.viscous[k] = sums.lost[k] = 0.0;
    }
    for (std::int64_t i = 0; i < train.lanes; ++i)
        sums.touching[i] = sums.clipped[i] = sums.rolled[i] = 0.0;
}

// Films of a train without friction, under the pushes in `work`.
inline void find_contacts(const Model& model, const StepConstants& constants, const double* v,
                          Evaluation& work) {
    share_loads(model, constants, work);
    turn_pairs(model.train, constants, v, work.pairs);
    evaluate(model, work.pairs);
}

// Add shares and films of all pairs, times `weight` [s].
inline void add_films(const Train& train, const ToothPairs& pairs, double weight,
                      ContactSums& sums) {
    const std::int64_t width = width_of_pairs(train);
    for (std::int64_t k = 0; k < width; ++k) {
        double share = weight * pairs.share[k];
        sums.share[k] += share;
        sums.film[k] += share * exp(pairs.log_film[k]);
    }
}

// Add friction and forces of an evaluation, times `weight` [s].
inline void add_friction(const Train& train, const Evaluation& work, double weight,
                         ContactSums& sums) {
    const ToothPairs& pairs = work.pairs;
    const MeshesNow& now = work.now;
    double rolling = weight * train.base_pitch * std::fabs(now.pace);
    for (std::int64_t i = 0; i < train.lanes; ++i) {
        double push = now.push[i];
        sums.touching[i] += push != 0.0 ? weight : 0.0;
        sums.rolled[i] += rolling * std::max(push, 0.0);
    }
    if (!train.friction) return;
    const std::int64_t width = width_of_pairs(train);
    for (std::int64_t k = 0; k < width; ++k) {
        sums.boundary[k] += weight * pairs.boundary[k];
        sums.viscous[k] += weight * pairs.viscous[k];
        double lost = pairs.friction[k] * pairs.sliding[k] + pairs.rolling_power[k];
        sums.lost[k] += weight * lost;
    }
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double viscous = 0.0;
        for (std::int64_t p = 0; p < train.slots; ++p) viscous += pairs.viscous[p * train.meshes + i];
        sums.clipped[i] += now.push[i] > 0.0 && viscous == 0.0 ? weight : 0.0;
    }
}

// Write the sums of the pairs of each mesh into `out`, the integrals of a MeshSums.
inline void put_contacts(const Train& train, const Oil& oil, const ContactSums& sums,
                         double (*out)[MESHES]) {
    const double given = oil.prescribed ? oil.lambda_ratio : 0.0;
    const double per_film = oil.prescribed ? 0.0 : exp(-oil.log_roughness);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double share = 0.0, film = 0.0, boundary = 0.0, viscous = 0.0, lost = 0.0;
        for (std::int64_t p = 0; p < train.slots; ++p) {
            std::int64_t k = p * train.meshes + i;
            share += sums.share[k];
            film += sums.film[k];
            boundary += sums.boundary[k];
            viscous += sums.viscous[k];
            lost += sums.lost[k];
        }
        out[FILMED][i] = share;
        out[FILM][i] = film;
        out[LAMBDA][i] = given * share + per_film * film;
        out[BOUNDARY][i] = boundary;
        out[VISCOUS][i] = viscous;
        out[POWER_LOSS][i] = lost;
        out[CONTACT][i] = sums.touching[i];
        out[MESH_POWER][i] = sums.rolled[i];
        out[CLIPPED][i] = train.friction ? sums.clipped[i] : sums.touching[i];
    }
}

}  // namespace gearbox
