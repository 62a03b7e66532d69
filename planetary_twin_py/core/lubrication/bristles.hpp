#pragma once

// Static friction of all tooth pairs, where the gears creep or are at rest.
//
// The traction curve of a rolling contact becomes narrower with decreasing rolling speed. Below
// CREEPING it is replaced by a bristle model, see `presliding.hpp`: each tooth pair has its share
// of the full friction as a state variable.

#include <cmath>

#include "capacities.hpp"
#include "lubrication/oil.hpp"
#include "lubrication/presliding.hpp"
#include "lubrication/tooth_pairs.hpp"
#include "model/train.hpp"

namespace gearbox {

constexpr double CREEPING = 5e-3;  // [m/s] rolling speed below which tooth pairs have bristles
constexpr double LEAST_FRICTION = 1e-12;  // [N] pairs with less friction have no bristles

// Whether the frame is so slow that tooth pairs have bristles.
inline bool creeps(const Train& train, double cycle_rate) {
    bool slow = train.geometry.rolling_advance * std::abs(cycle_rate) < CREEPING;
    return slow && train.friction && !train.printed_torque;
}

// Set the shares of friction of the pairs from those of a state.
inline void place_bristles(ToothPairs& pairs, const double* share) {
    if (!pairs.has_bristles) return;
    for (int k = 0; k < PAIR_CAPACITY; ++k) pairs.bristle[k] = share[k];
}

// Replace the friction of the traction curve by that of the bristles.
//
// Reads the friction of `evaluate` and the shares in `pairs.bristle`.
inline void apply_bristles(const Oil& oil, ToothPairs& pairs) {
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        double full = pairs.boundary[k] + pairs.viscous[k], share = pairs.bristle[k];
        double force = share;
        pairs.full[k] = full;
        pairs.bristle_rate[k] = pairs.bristle_decay[k] = pairs.bristle_gain[k] = 0.0;
        pairs.lost[k] = 0.0;
        if (!(full <= LEAST_FRICTION)) {
            double steady = pairs.friction[k] / full, slope = pairs.slope[k] / full;
            auto [rate, decay, gain, slip] =
                bristle_rate(share, pairs.sliding[k], steady, slope, oil.presliding);
            pairs.bristle_rate[k] = rate;
            pairs.bristle_decay[k] = decay;
            pairs.bristle_gain[k] = gain;
            double damping = RELAXATION * rate;
            force += damping;
            pairs.lost[k] = full * (share * slip + damping * pairs.sliding[k]);
        }
        pairs.friction[k] = full * force;
        pairs.boundary[k] *= std::abs(force);
        pairs.viscous[k] *= std::abs(force);
    }
}

// Elastic energy of the bristles [J]: half the presliding displacement times full z^2 of each pair,
// z the share.
inline double bristle_energy(const Train& train, const Oil& oil, const ToothPairs& pairs) {
    double total = 0.0;
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        double copies = train.mesh.copies[k % train.meshes];
        total += copies * pairs.full[k] * pairs.bristle[k] * pairs.bristle[k];
    }
    return 0.5 * oil.presliding * total;
}

// Fill the shares of friction (PAIR_CAPACITY,) from the traction curve, at the start of the bristle
// model.
inline void steady_bristles(const ToothPairs& pairs, double* share) {
    for (int k = 0; k < PAIR_CAPACITY; ++k) share[k] = 0.0;
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        double full = pairs.boundary[k] + pairs.viscous[k];
        if (full > LEAST_FRICTION) share[k] = pairs.friction[k] / full;
    }
}

// Transfer the shares of the pairs of mesh i from a segment to the next in a direction.
//
// The position of a pair is cycle + shift: where the cycle restarts, its shift is larger by one.
inline void pass_bristles(const Train& train, double* share, std::int64_t i, std::int64_t segment,
                          std::int64_t direction) {
    std::int64_t kind = train.mesh.kind[i], count = train.teeth.segments[kind];
    std::int64_t after = (segment + direction + count) % count;
    double wrapped = after != segment + direction ? static_cast<double>(direction) : 0.0;
    const double *before = train.teeth.shift[kind][segment], *now = train.teeth.shift[kind][after];
    double old[PAIRS] = {};
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        double& place = share[p * train.meshes + i];
        old[p] = place;
        place = 0.0;
    }
    for (std::int64_t q = 0; q < train.teeth.present[kind][segment]; ++q)
        for (std::int64_t p = 0; p < train.teeth.present[kind][after]; ++p)
            if (now[p] == before[q] + wrapped) share[p * train.meshes + i] = old[q];
}

// Set the shares of mesh i to zero when its flanks separate or come into contact.
inline void clear_bristles(const Train& train, double* share, std::int64_t i) {
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) share[p * train.meshes + i] = 0.0;
}

}  // namespace gearbox
