#pragma once

// Damage of teeth, bearings and shafts as the train turns.
//
// Every passage of a tooth through a mesh is one pulse of load, from nothing to its peak and back.
// When a pair has left the mesh, one over the life at its peaks adds to the sums of both flanks and
// both roots (Palmgren 1924, Miner 1945).

#include "lubrication/mesh_friction.hpp"
#include "lubrication/tooth_contact.hpp"
#include "mesh/mesh_forces.hpp"
#include "mesh/mesh_sums.hpp"
#include "model/model.hpp"
#include "model/passages_record.hpp"
#include "vector/rows.hpp"

namespace gearbox {

// Stresses of the pairs at an instant, by their slots.
struct alignas(64) PairStresses {
    alignas(64) double row[STRESSES][PAIRS][MESHES];
};

// Peaks over a step.
struct alignas(64) StepPeaks {
    PairStresses stress;
    alignas(64) double flash[MESHES];     // temperature [K]
    alignas(64) double per_film[MESHES];  // one over the thinnest film [1/m]
};

// End the passages of pairs that have left the meshes at a state, whose constants are `step`.
void end_passages(const Train& train, const State& state, const StepConstants& step,
                  Passages& passages, MeshSums& sums);

// Keep the peaks of a step from a state: of its pairs, and as extremes.
void keep_peaks(const Model& model, const State& state, const StepPeaks& peaks, Passages& passages,
                MeshSums& sums);

// Whether bearings are rated.
bool has_bearings(const Train& train);

// Fill the rates of damage of the bearings at an instant of a motion.
void rate_bearings(const Model& model, const StepConstants& step, const MeshesNow& now,
                   const double* x, const double* v, BearingRates& rate);

// Add these rates, times `weight` [s].
void add_bearings(const Train& train, const BearingRates& rate, double weight, MeshSums& sums);

inline bool has_shafts(const Train& train) {
    bool has = false;
    for (std::int64_t c = 0; c < train.machines; ++c) has |= train.durability.shaft[c].range > 0.0;
    return has;
}

// Continue the torques of the shafts to these [N m].
void follow_shafts(const Train& train, const double* torque, Passages& passages, MeshSums& sums);

// Go on counting after mesh cycles of the frame, signed, that were not followed.
void skip_cycles(const Train& train, std::int64_t cycles, Passages& passages);

// Count the whole cycles of the meshes from a state on, which follows a repeated cycle.
void renumber(const Train& train, const State& state, const StepConstants& step,
              Passages& passages);

// Add passages, `ahead` mesh cycles later, and `times` in all, each `stride` mesh cycles after the
// one before.
void add_passed(const std::vector<Passed>& passed, std::int64_t ahead, std::int64_t times,
                std::int64_t stride, MeshSums& sums);

void clear_damage(MeshSums& sums);

template <int L>
ALWAYS_INLINE void raise(double* peaks, const Row<L>& values) {
    larger(Row<L>(peaks), values).store(peaks);
}

template <int L>
ALWAYS_INLINE void clear_contacts(StepPeaks& peaks) {
    Row<L>(0.0).store(peaks.flash);
    Row<L>(0.0).store(peaks.per_film);
}

// Fill the stresses of the pairs at an instant of a step.
template <int L>
void find_stresses(const Train& train, const StepConstants& step, const MeshesNow& now,
                   PairStresses& found) {
    using V = Row<L>;
    const Durability& durability = train.durability;
    const V moved = path_position<L>(train, step, now.advance);
    const V distance = distance_of(V(step.rho1[0]), V(step.rho2[0]), V(step.external));
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        const V load(now.load[p]);
        const auto [rho1, rho2] = flank_radii<L>(step, p, moved);
        const V radii = rho1 * rho2 * face_in_contact<L>(step, p, now.advance);
        const V square = load * distance / radii * durability.pressure;
        const Mask<L> carries = (load > 0.0) & (radii > 0.0);
        select(carries, square, 0.0).store(found.row[CONTACT_STRESS][p]);
        const V along = rho1 * V(durability.gain) + V(durability.offset);
        const V place = smaller(larger(along, V(-1.0)), V(1.0));
        for (int gear = 0; gear < 2; ++gear) {
            V stress(durability.root_stress[gear][ROOT_TERMS - 1]);
            for (int n = ROOT_TERMS - 2; n >= 0; --n)
                stress = fused(stress, place, V(durability.root_stress[gear][n]));
            select(carries, stress * load, 0.0).store(found.row[ROOT_STRESS + gear][p]);
        }
    }
}

// Raise the peaks to the contacts at an instant.
template <int L>
ALWAYS_INLINE void raise_contacts(const MeshFriction& friction, StepPeaks& peaks) {
    raise<L>(peaks.flash, Row<L>(friction.flash));
    raise<L>(peaks.per_film, Row<L>(friction.per_film));
}

}  // namespace gearbox
