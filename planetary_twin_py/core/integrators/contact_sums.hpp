#pragma once

// Integrals of films and friction of all tooth pairs over a step.

#include <cmath>

#include "lubrication/tooth_friction.hpp"
#include "mesh/mesh_forces.hpp"
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

// Add shares and films of the meshes at an instant, times `weight` [s].
template <int L>
ALWAYS_INLINE void add_films(const Train& train, const MeshesNow& now, const MeshFriction& friction,
                             double weight, ContactSums<L>& sums) {
    for (std::int64_t p = 0; p < train.teeth.slots; ++p)
        sums.share = fused(weight, Row<L>(now.share[p]), sums.share);
    sums.film = fused(weight, Row<L>(friction.film), sums.film);
}

// Add forces and friction of the meshes at an instant, times `weight` [s].
template <int L>
ALWAYS_INLINE void add_friction(const Train& train, const MeshesNow& now,
                                const MeshFriction& friction, double weight, ContactSums<L>& sums) {
    using V = Row<L>;
    const double rolling = weight * train.geometry.base_pitch * std::fabs(now.cycle_rate);
    V normal_force(now.normal_force);
    Mask<L> loaded = normal_force > 0.0;
    sums.touching += select(normal_force == 0.0, 0.0, V(weight));
    sums.rolled = fused(rolling, select(loaded, normal_force, 0.0), sums.rolled);
    if (!train.friction) return;
    V viscous(friction.viscous);
    sums.boundary = fused(weight, V(friction.boundary), sums.boundary);
    sums.viscous = fused(weight, viscous, sums.viscous);
    sums.lost = fused(weight, V(friction.lost), sums.lost);
    sums.clipped += select(loaded & (viscous == 0.0), V(weight), 0.0);
}

// Add films, forces and friction of an evaluation with `find_friction_of_pairs`, times `weight`.
template <int L>
ALWAYS_INLINE void add_evaluation(const Train& train, double weight, Evaluation& work,
                                  ContactSums<L>& sums) {
    collect_parts(train, work.pairs, true, work.friction);
    add_films(train, work.now, work.friction, weight, sums);
    add_friction(train, work.now, work.friction, weight, sums);
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
