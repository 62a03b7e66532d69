#pragma once

// Forces of bearings and their pits, weight and the rotating frame on the displacements of the
// axes.
//
// Coriolis and centripetal terms are those of Lin and Parker 1999, eq. (9), except that the
// centripetal force on a planet across its radius acts on its displacement relative to the pin:
// with eta itself a wound-up carrier would be accelerated, and torques would not balance.

#include "capacities.hpp"
#include "model/bearings.hpp"
#include "model/state.hpp"
#include "model/tilting.hpp"
#include "model/train.hpp"
#include "model/weight.hpp"
#include "vector/attributes.hpp"

namespace gearbox {

// Forces on the displacements of the carrier and on its rotation, to which all planet bearings add.
// A sum in memory could only be read some time after it is written.
struct CarrierForces {
    double along, across, turning;
};

inline CarrierForces forces_on_carrier(const Train& train, const double* force) {
    const std::int64_t* carrier = train.moving.carrier;
    return {force[carrier[0]], force[carrier[1]], force[train.carrier]};
}

inline void set_on_carrier(const Train& train, const CarrierForces& sums, double* force) {
    const std::int64_t* carrier = train.moving.carrier;
    force[carrier[0]] = sums.along;
    force[carrier[1]] = sums.across;
    force[train.carrier] = sums.turning;
}

// Add the reaction on the carrier of a force on the body on bearing b.
inline void react(const MovingAxes& axes, std::int64_t b, const InPlane& force,
                  CarrierForces& carrier) {
    auto [cosine, sine] = axes.direction[b];
    carrier.along -= cosine * force.along - sine * force.across;
    carrier.across -= sine * force.along + cosine * force.across;
    carrier.turning -= axes.carried[b] * force.across;
}

// Add the forces and torques of the pits in bearings, and the power that they gain as their
// supports turn with the frame, at `turning` [rad/s].
inline void add_pits(const Train& train, const State& state, double turning, double delay,
                     const double* x, double* force, double& power) {
    for (std::int64_t k = 0; k < train.moving.pits; ++k) {
        const BearingPit& pit = train.moving.pit[k];
        const PitEffect effect = effect_of_pit(train, state, k, delay, x);
        force[train.moving.place[pit.bearing][0]] += effect.force.along;
        force[train.moving.place[pit.bearing][1]] += effect.force.across;
        CarrierForces carrier = forces_on_carrier(train, force);
        react(train.moving, pit.bearing, effect.force, carrier);
        set_on_carrier(train, carrier, force);
        force[pit.body] += effect.torque * train.body.inverse_radius[pit.body];
        if (on_carrier(train.moving, pit.bearing))
            force[train.carrier] -= effect.torque * train.body.inverse_radius[train.carrier];
        power += effect.turning * turning;
    }
}

// Add the Coriolis and centrifugal forces on the body on bearing b.
inline void add_inertial(const Train& train, std::int64_t b, double turning, const double* x,
                         const double* v, InPlane& force, CarrierForces& carrier) {
    const MovingAxes& axes = train.moving;
    const std::int64_t along = axes.place[b][0], across = axes.place[b][1];
    const double m = axes.mass[b], square = turning * turning;
    double arm = on_carrier(axes, b) ? axes.arm : 0.0;
    double beside = x[across] - axes.carried[b] * x[train.carrier];
    force.along += m * (2.0 * turning * v[across] + square * (arm + x[along]));
    force.across += m * (square * beside - 2.0 * turning * v[along]);
    carrier.turning -= axes.carried[b] * m * square * beside;
}

// Add the forces of bearing b and of the rotating frame on the body on it in the plane; return the
// power lost to damping [W].
ALWAYS_INLINE double push_in_plane(const Train& train, std::int64_t b, double turning,
                                   const double* x, const double* v, double* force,
                                   CarrierForces& carrier) {
    const auto [along, across] = train.moving.place[b];
    if (along == train.bodies) return 0.0;  // the ground: where all planets mesh in phase
    const auto [reaction, lost] = bearing_force(train, b, turning, x, v);
    InPlane sum{force[along] + reaction.along, force[across] + reaction.across};
    react(train.moving, b, reaction, carrier);
    if (turning != 0.0) add_inertial(train, b, turning, x, v, sum, carrier);
    force[along] = sum.along;
    force[across] = sum.across;
    return lost;
}

// Add the forces of bearings, weight and the rotating frame on the axes, `delay` seconds after a
// state, and their powers in the ledger to `power` [W]. `rigid` has the speeds of the frame
// [rad/s].
inline void apply_axes(const Train& train, const State& state, const double* rigid, double delay,
                       const double* x, const double* v, double* force, double* power) {
    const MovingAxes& axes = train.moving;
    const double turning = rigid[axes.frame];
    if (axes.gravity != 0.0) {
        const InPlane gravity = gravity_at(train, frame_angle(train, state, delay), x);
        add_weight(train, turning, gravity, x, v, force, power[WEIGHT]);
    }
    CarrierForces carrier{};
    double lost = power[DAMPING];
    for (std::int64_t b = 0; b < axes.bearings; ++b) {
        // Those before are in the housing and do not react on the carrier; one of them is its own.
        if (b == MEMBERS) carrier = forces_on_carrier(train, force);
        lost += push_in_plane(train, b, turning, x, v, force, carrier);
        if (!tilts(train)) continue;
        lost += tilt_bearing(train, b, turning, x, v, force);
        add_gyroscopic(train, b, turning, rigid[axes.tilting[b].turns], x, v, force);
    }
    if (axes.bearings > MEMBERS) set_on_carrier(train, carrier, force);
    power[DAMPING] = lost;
    add_pits(train, state, turning, delay, x, force, power[STIFFNESS_WORK]);
    force[train.bodies] = 0.0;  // the ground
}

}  // namespace gearbox
