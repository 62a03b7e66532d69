#pragma once

// Bearings of the axes: their laws, forces and energies.
//
// A bearing reacts with k (r - c) against the displacement r beyond its clearance c, or by the law
// of rolling bearings, and with damping; its force never acts in the direction of the displacement.
// Bearings of sun, ring and carrier are at rest in the housing, so their damping acts on the motion
// relative to the housing.

#include <cmath>

#include "capacities.hpp"
#include "model/bearing_pits.hpp"
#include "model/rolling_bearing.hpp"
#include "model/state.hpp"
#include "model/tilting.hpp"
#include "model/train.hpp"
#include "model/weight.hpp"
#include "vector/math.hpp"

namespace gearbox {

inline bool on_carrier(const MovingAxes& axes, std::int64_t b) {
    return axes.carried[b] != 0.0;
}

// Displacement of the body on bearing b relative to its support, from x; its rate from v.
inline InPlane across_bearing(const Train& train, std::int64_t b, const double* x) {
    const MovingAxes& axes = train.moving;
    auto [cosine, sine] = axes.direction[b];
    double a = x[axes.carrier[0]], c = x[axes.carrier[1]];
    return {x[axes.place[b][0]] - (cosine * a + sine * c),
            x[axes.place[b][1]] + (sine * a - cosine * c) - axes.carried[b] * x[train.carrier]};
}

// Displacement of the body on bearing b from its centred position [m].
inline InPlane from_centre(const Train& train, std::int64_t b, const double* x) {
    const InPlane r = across_bearing(train, b, x);
    const double* centre = train.moving.centre[b];
    return {r.along - centre[0], r.across - centre[1]};
}

// Eccentricity of bearing b relative to its centred position [m].
inline double eccentricity(const Train& train, std::int64_t b, const double* x) {
    const auto [along, across] = from_centre(train, b, x);
    return std::sqrt(along * along + across * across);
}

inline bool rolls(const MovingAxes& axes, std::int64_t b) {
    return axes.rolling[b].strength > 0.0;
}

// Whether the force of bearing b is linear in the displacement.
inline bool is_linear(const MovingAxes& axes, std::int64_t b) {
    return axes.clearance[b] == 0.0 && !rolls(axes, b);
}

// Response of bearing b to an eccentricity of `size` [m].
inline BearingResponse bearing_law(const MovingAxes& axes, std::int64_t b, double size) {
    if (rolls(axes, b)) return rolling_bearing_law(axes.rolling[b], axes.clearance[b], size);
    const double k = axes.stiffness[b], penetration = size - axes.clearance[b];
    if (!(penetration > 0.0)) return {0.0, 0.0, 0.0};
    return {0.5 * k * penetration * penetration, k * penetration, k};
}

// Damping [N s/m] of bearing b along its eccentricity and across it. A rolling bearing is damped in
// proportion to its stiffness in either direction.
struct RadialDamping {
    double along, across;
};

inline RadialDamping radial_damping(const MovingAxes& axes, std::int64_t b,
                                    const BearingResponse& at, double size) {
    if (!rolls(axes, b)) return {axes.damping[b], 0.0};
    const double time = axes.rolling[b].damping_time;
    return {time * at.stiffness, time * at.force / size};
}

struct BearingForce {
    InPlane reaction;  // on the body [N]
    double lost;       // to damping [W]
};

// Force of bearing b in a frame that turns at `turning` [rad/s].
inline BearingForce bearing_force(const Train& train, std::int64_t b, double turning,
                                  const double* x, const double* v) {
    const MovingAxes& axes = train.moving;
    const InPlane r = from_centre(train, b, x), rate = across_bearing(train, b, v);
    InPlane against = rate;
    if (!on_carrier(axes, b)) {
        against.along -= turning * r.across;
        against.across += turning * r.along;
    }
    if (is_linear(axes, b)) {
        const double k = axes.stiffness[b], c = axes.damping[b];
        InPlane damped{-c * against.along, -c * against.across};
        return {{damped.along - k * r.along, damped.across - k * r.across},
                -(damped.along * rate.along + damped.across * rate.across)};
    }
    const double size = std::sqrt(r.along * r.along + r.across * r.across);
    const BearingResponse at = bearing_law(axes, b, size);
    if (!(at.force > 0.0)) return {{0.0, 0.0}, 0.0};
    const RadialDamping damping = radial_damping(axes, b, at, size);
    const double nx = r.along / size, ny = r.across / size;
    const double normal =
        std::fmax(at.force + damping.along * (nx * against.along + ny * against.across), 0.0);
    const double tangential = damping.across * (nx * against.across - ny * against.along);
    return {{-normal * nx + tangential * ny, -normal * ny - tangential * nx},
            (normal - at.force) * (nx * rate.along + ny * rate.across) +
                tangential * (nx * rate.across - ny * rate.along)};
}

// Effect of pit k, `delay` seconds after a state.
inline PitEffect effect_of_pit(const Train& train, const State& state, std::int64_t k, double delay,
                               const double* x) {
    const BearingPit& pit = train.moving.pit[k];
    return pit_effect(train.moving, pit, place_of_pit(train, state, pit, delay, x),
                      from_centre(train, pit.bearing, x));
}

// Displacement of the body on bearing b, without that by the rotation of the carrier, and its force
// on the bearing without pits, two components each.
inline void show_bearing(const Train& train, std::int64_t b, double turning, const double* x,
                         const double* v, double* out) {
    const MovingAxes& axes = train.moving;
    const InPlane reaction = bearing_force(train, b, turning, x, v).reaction;
    out[0] = x[axes.place[b][0]];
    out[1] = x[axes.place[b][1]] - axes.carried[b] * x[train.carrier];
    out[2] = -reaction.along;
    out[3] = -reaction.across;
}

// Rows of the displacement across bearing b in the plane and, if axes tilt, of the axial one and
// the tilts.
inline BearingRows rows_of_bearing(const Train& train, std::int64_t b) {
    const MovingAxes& axes = train.moving;
    auto [cosine, sine] = axes.direction[b];
    const double k = axes.stiffness[b], c = axes.damping[b];
    const std::int64_t along = axes.place[b][0], across = axes.place[b][1];
    const std::int64_t* carrier = axes.carrier;
    BearingRows rows{};
    rows.add({true,
              5,
              {along, across, carrier[0], carrier[1], train.carrier},
              {1.0, 0.0, -cosine, -sine, 0.0},
              k,
              c});
    rows.add({true,
              5,
              {along, across, carrier[0], carrier[1], train.carrier},
              {0.0, 1.0, sine, -cosine, -axes.carried[b]},
              k,
              c});
    if (tilts(train)) add_tilting_rows(train, b, rows);
    return rows;
}

// Elastic energy of bearing b [J].
inline double bearing_energy(const Train& train, std::int64_t b, const double* x) {
    return bearing_law(train.moving, b, eccentricity(train, b, x)).energy;
}

// Whether bearing b is beyond its clearance at x.
inline bool beyond_clearance(const Train& train, std::int64_t b, const double* x) {
    if (is_linear(train.moving, b)) return true;
    return bearing_energy(train, b, x) > 0.0;
}

// Energy [J] of the centrifugal forces in the frame, a part of the kinetic energy: that of the
// rigid motion of the frame in addition to the speeds of the bodies.
inline double centrifugal_energy(const Train& train, double turning, const double* x) {
    const MovingAxes& axes = train.moving;
    double total = 0.0;
    for (std::int64_t b = 0; b < axes.bearings; ++b) {
        double along = x[axes.place[b][0]];
        double beside = x[axes.place[b][1]] - axes.carried[b] * x[train.carrier];
        double arm = on_carrier(axes, b) ? axes.arm : 0.0;
        total += axes.mass[b] * (arm * along - 0.5 * (along * along + beside * beside));
    }
    return turning * turning * total;
}

// Reaction of planets that are displaced along their radius, on a carrier that is faster by `rate`
// [rad/s]: the force that accelerates a planet acts at its displaced place.
//
// Without it, the moment of inertia would be that of planets in their places, but the centrifugal
// forces would do work on displaced ones.
inline void accelerate_displaced(const Train& train, double rate, State& state) {
    const MovingAxes& axes = train.moving;
    for (std::int64_t b = 0; b < axes.bearings; ++b)
        state.v[train.carrier] -= axes.carried[b] * axes.mass[b] * state.x[axes.place[b][0]] *
                                  rate / train.body.mass[train.carrier];
}

// Transform the displacements to a frame that is ahead by `angle` [rad] and faster by `rate`
// [rad/s], after the rigid motion has been subtracted.
inline void turn_displacements(const Train& train, double angle, double rate, State& state) {
    const MovingAxes& axes = train.moving;
    accelerate_displaced(train, rate, state);
    auto [sine, cosine] = sin_cos(angle);
    for (std::int64_t b = 0; b < axes.bearings; ++b) {
        if (axes.leads[b] == 0) continue;
        const std::int64_t along = axes.place[b][0], across = axes.place[b][1];
        double *x = state.x, *v = state.v;
        double beside = x[across] - axes.carried[b] * x[train.carrier];
        if (!on_carrier(axes, b)) {
            double a = x[along], c = x[across], p = v[along], q = v[across];
            x[along] = cosine * a + sine * c;
            x[across] = beside = cosine * c - sine * a;
            v[along] = cosine * p + sine * q;
            v[across] = cosine * q - sine * p;
        }
        v[along] += rate * beside;
        v[across] -= rate * x[along];
        if (tilts(train)) turn_tilts(train, b, {sine, cosine}, rate, x, v);
    }
}

}  // namespace gearbox
