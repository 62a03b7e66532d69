#pragma once

// Integrals of films and friction of all tooth pairs over a step.

#include <cmath>

#include "integrators/node.hpp"
#include "lubrication/tooth_friction.hpp"
#include "mesh/mesh_forces.hpp"
#include "model/model.hpp"
#include "model/step_constants.hpp"
#include "vector/math.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Sums over the tooth pairs of each mesh.
template <int L>
struct ContactSums {
    Row<L> share = 0.0;                    // of the mesh force [s]
    Row<L> film = 0.0;                     // by that share [m s]
    Row<L> boundary = 0.0, viscous = 0.0;  // [N s]
    Row<L> lost = 0.0;                     // [J]
    Row<L> touching = 0.0, clipped = 0.0;  // [s]
    Row<L> rolled = 0.0;                   // through the mesh [J]
};

// Films of a train without friction, under the mesh forces in `work`.
inline void find_contacts(const Model& model, const StepConstants& constants, const double* v,
                          Evaluation& work) {
    share_loads(model, constants, work);
    turn_pairs(model.train, constants, v, work.pairs);
    evaluate(model, work.pairs);
}

// Add shares and films of all pairs, times `weight` [s].
template <int L>
ALWAYS_INLINE void add_films(const Train& train, const ToothPairs& pairs, double weight,
                             ContactSums<L>& sums) {
    for (std::int64_t p = 0, first = 0; p < train.slots; ++p, first += train.meshes) {
        alignas(64) double film[L];
        for (int i = 0; i < L; ++i) film[i] = exp(pairs.log_film[first + i]);
        Row<L> share = weight * Row<L>(pairs.share + first);
        sums.share += share;
        sums.film += share * Row<L>(film);
    }
}

// Add friction and forces of an evaluation, times `weight` [s].
template <int L>
ALWAYS_INLINE void add_friction(const Train& train, const Evaluation& work, double weight,
                                ContactSums<L>& sums) {
    using V = Row<L>;
    const ToothPairs& pairs = work.pairs;
    const double rolling = weight * train.base_pitch * std::fabs(work.now.cycle_rate);
    V normal_force(work.now.normal_force);
    Mask<L> loaded = normal_force > 0.0;
    sums.touching += select(normal_force == 0.0, 0.0, V(weight));
    sums.rolled += rolling * select(loaded, normal_force, 0.0);
    if (!train.friction) return;
    V viscous(0.0);
    for (std::int64_t p = 0, first = 0; p < train.slots; ++p, first += train.meshes) {
        viscous += V(pairs.viscous + first);
        sums.boundary += weight * V(pairs.boundary + first);
        V lost = pairs.has_bristles ? V(pairs.lost + first)
                                    : V(pairs.friction + first) * V(pairs.sliding + first);
        sums.lost += weight * (lost + V(pairs.rolling_power + first));
    }
    sums.viscous += weight * viscous;
    sums.clipped += select(loaded & (viscous == 0.0), V(weight), 0.0);
}

// Add shares and films at a node, times `weight` [s].
template <int L>
ALWAYS_INLINE void add_films(const Train& train, const Node& node, double weight,
                             ContactSums<L>& sums) {
    for (std::int64_t p = 0; p < train.slots; ++p)
        sums.share = fused(weight, Row<L>(node.meshes.share[p]), sums.share);
    sums.film = fused(weight, Row<L>(node.friction.film), sums.film);
}

// Add the results of `find_friction` at a node, times `weight` [s].
template <int L>
ALWAYS_INLINE void add_node(const Train& train, const Node& node, double weight,
                            ContactSums<L>& sums) {
    using V = Row<L>;
    const MeshFriction& friction = node.friction;
    const double rolling = weight * train.base_pitch * std::fabs(node.meshes.cycle_rate);
    V normal_force(node.meshes.normal_force);
    Mask<L> loaded = normal_force > 0.0;
    sums.touching += select(normal_force == 0.0, 0.0, V(weight));
    sums.rolled = fused(rolling, select(loaded, normal_force, 0.0), sums.rolled);
    if (!train.friction) return;
    add_films(train, node, weight, sums);
    V viscous(friction.viscous);
    sums.boundary = fused(weight, V(friction.boundary), sums.boundary);
    sums.viscous = fused(weight, viscous, sums.viscous);
    sums.lost = fused(weight, V(friction.lost), sums.lost);
    sums.clipped += select(loaded & (viscous == 0.0), V(weight), 0.0);
}

// Write the sums into `out`, the integrals of a MeshSums.
template <int L>
ALWAYS_INLINE void put_contacts(const Train& train, const Oil& oil, const ContactSums<L>& sums,
                                double (*out)[MESHES]) {
    const double given = oil.prescribed ? oil.lambda_ratio : 0.0;
    const double per_film = oil.prescribed ? 0.0 : exp(-oil.log_roughness);
    // Entries beyond the meshes contain values of the next pairs, because whole registers are read.
    const Mask<L> used = first_of_row<L>(train.meshes);
    auto put = [&](int row, const Row<L>& sum) { select(used, sum, 0.0).store(out[row]); };
    put(FILMED, sums.share);
    put(FILM, sums.film);
    put(LAMBDA, given * sums.share + per_film * sums.film);
    put(BOUNDARY, sums.boundary);
    put(VISCOUS, sums.viscous);
    put(POWER_LOSS, sums.lost);
    put(CONTACT, sums.touching);
    put(MESH_POWER, sums.rolled);
    put(CLIPPED, train.friction ? sums.clipped : sums.touching);
}

}  // namespace gearbox
