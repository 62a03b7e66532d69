#pragma once

// How the tooth pairs of a mesh share a given force, e.g. a recorded one.
//
// The pairs have the stiffnesses k and the missing material g of `faulty_mesh_force`, at the
// deflection q at which they carry the force F: F = sum of k (q - g) over the pairs with q > g.
// Damping acts on all pairs in proportion to k, so it does not change the shares, except for a worn
// pair that only just touches.

#include <cmath>

#include "mesh/cycle.hpp"
#include "mesh/faults.hpp"
#include "mesh/stiffness.hpp"

namespace gearbox {

// Fill the loads (PAIRS,) that add up to `force`; pairs with negative loads are removed one by one.
inline void balance_pairs(const Train& train, const StepConstants& step, std::int64_t i,
                          std::int64_t segment, double u, double force, double* load) {
    std::int64_t present = train.teeth.present[train.mesh.kind[i]][segment];
    for (std::int64_t p = 0; p < present; ++p) load[p] = 1.0;
    for (std::int64_t pass = 0; pass < present; ++pass) {
        double stiffness = 0.0, deflection = force;
        for (std::int64_t p = 0; p < present; ++p) {
            if (!(load[p] > 0.0)) continue;
            auto [k, gap] = pair_stiffness(train, step, i, segment, p, u);
            stiffness += k;
            deflection += k * gap;
        }
        deflection /= stiffness;
        for (std::int64_t p = 0; p < present; ++p) {
            if (!(load[p] > 0.0)) continue;
            auto [k, gap] = pair_stiffness(train, step, i, segment, p, u);
            load[p] = at_least(k * (deflection - gap), 0.0);
        }
    }
}

// The contacts of the pairs of a mesh, (PAIRS,) each.
struct PairContacts {
    double* position;  // of the middle of the line of contact [base pitches]
    double* ahead;     // of the middle, relative to the middle of the face [base pitches]
    double* face;      // part of the face in contact
    double* load;      // [N]
};

// Fill the contacts of the pairs of mesh i under a force [N] that is not zero. `cycles` are those
// of the train, `counted` (faults,) the same by the gear of each fault; `step` is work space for
// the faults.
inline void share_force(const Train& train, StepConstants& step, std::int64_t i, double cycles,
                        const double* counted, double force, const PairContacts& contact) {
    std::int64_t kind = train.mesh.kind[i], side = force > 0.0 ? DRIVE_SIDE : COAST_SIDE;
    double cycle = cycle_on_side(train, i, side, cycles, 1);
    std::int64_t segment = find_segment(train, kind, cycle, 1.0);
    clear_faults(step, i);
    for (std::int64_t f = 0; f < train.faults.count; ++f) {
        double own = cycle_on_side(train, i, side, counted[f], train.faults.teeth[f]);
        auto whole = static_cast<std::int64_t>(std::nearbyint(own - cycle));
        mark_fault(train, i, side, segment, f, whole, step);
    }
    for (int p = 0; p < PAIRS; ++p) {
        double place =
            train.teeth.centre[kind][segment][p] + train.teeth.travel[kind][segment][p] * cycle;
        contact.position[p] = place;
        contact.ahead[p] = place - cycle - std::floor(train.teeth.shift[kind][segment][p]);
        contact.face[p] =
            train.teeth.face[kind][segment][p] + train.teeth.face_growth[kind][segment][p] * cycle;
    }
    double u = cycle - train.teeth.edge[kind][segment];
    balance_pairs(train, step, i, segment, u, std::abs(force), contact.load);
}

}  // namespace gearbox
