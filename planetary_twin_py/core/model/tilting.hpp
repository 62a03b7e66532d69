#pragma once

// Axial motion and tilts of the axes: bearings and gyroscopic moments.
//
// A body of polar inertia J_p and diametral inertia J_t with the spin w_0 has, in a frame that
// turns at W, the tilts theta = theta_x + i theta_y under a moment M,
//     J_t theta'' + i (2 W J_t - J_p w_0) theta' + (J_p w_0 W - J_t W^2) theta = M,
// from the change of its angular momentum (Goldstein 1980, Classical Mechanics, section 5.5, for
// small tilts). Bearings of sun, ring and carrier are at rest in the housing, so their damping acts
// on the rotation of the tilts, too. Those of planets are on the carrier, whose tilts displace and
// tilt the pins.

#include "capacities.hpp"
#include "model/train.hpp"
#include "model/weight.hpp"

namespace gearbox {

// Whether axial motion and tilts are simulated.
inline bool tilts(const Train& train) {
    return MOVING && train.moving.entries > IN_PLANE;
}

// One relative motion across a bearing.
struct BearingRow {
    bool radial;            // whether the clearance of the bearing applies
    int size;               // of the following two arrays
    std::int64_t place[5];  // coordinates
    double factor[5];       // of the coordinates in the motion across the bearing
    double stiffness;       // [N/m] or [N m/rad]
    double damping;         // [N s/m] or [N m s/rad]
};

struct BearingRows {
    BearingRow row[5];
    int count;

    void add(const BearingRow& next) { row[count++] = next; }
    const BearingRow* begin() const { return row; }
    const BearingRow* end() const { return row + count; }
};

// Motion across a bearing: along its axis, and tilts.
struct AxialTilt {
    double axial;  // [m]
    InPlane tilt;  // [rad]
};

// Motion of the body on bearing b relative to its support, from displacements x; its rate from v.
inline AxialTilt axial_tilt_across(const Train& train, std::int64_t b, const double* x) {
    const TiltingAxis &own = train.moving.tilting[b],
                      &carrier = train.moving.tilting[CARRIER_BEARING];
    AxialTilt motion{x[own.axial], {own.lever * x[own.place[0]], own.lever * x[own.place[1]]}};
    if (train.moving.carried[b] == 0.0) return motion;
    auto [cosine, sine] = train.moving.direction[b];
    double first = carrier.lever * x[carrier.place[0]],
           second = carrier.lever * x[carrier.place[1]];
    double along = cosine * first + sine * second, across = cosine * second - sine * first;
    return {motion.axial - x[carrier.axial] + train.moving.arm * across,
            {motion.tilt.along - along, motion.tilt.across - across}};
}

// Add a force and moments on the body on bearing b to `force`, and their reactions.
inline void add_axial_tilt(const Train& train, std::int64_t b, const AxialTilt& reaction,
                           double* force) {
    const TiltingAxis &own = train.moving.tilting[b],
                      &carrier = train.moving.tilting[CARRIER_BEARING];
    force[own.axial] += reaction.axial;
    force[own.place[0]] += own.lever * reaction.tilt.along;
    force[own.place[1]] += own.lever * reaction.tilt.across;
    if (train.moving.carried[b] == 0.0) return;
    auto [cosine, sine] = train.moving.direction[b];
    double along = -reaction.tilt.along,
           across = train.moving.arm * reaction.axial - reaction.tilt.across;
    force[carrier.axial] -= reaction.axial;
    force[carrier.place[0]] += carrier.lever * (cosine * along - sine * across);
    force[carrier.place[1]] += carrier.lever * (sine * along + cosine * across);
}

struct AxialTiltForce {
    AxialTilt reaction;  // force and moments on the body [N], [N m]
    double lost;         // to damping [W]
};

// Axial force and moments of bearing b in a frame that turns at `turning` [rad/s].
inline AxialTiltForce axial_tilt_force(const Train& train, std::int64_t b, double turning,
                                       const double* x, const double* v) {
    const TiltingAxis& own = train.moving.tilting[b];
    const AxialTilt at = axial_tilt_across(train, b, x), rate = axial_tilt_across(train, b, v);
    InPlane against = rate.tilt;
    if (train.moving.carried[b] == 0.0) {
        against.along -= turning * at.tilt.across;
        against.across += turning * at.tilt.along;
    }
    const double axial = own.axial_damping * rate.axial, c = own.tilting_damping;
    const double k = own.tilting_stiffness;
    return {{-own.axial_stiffness * at.axial - axial,
             {-k * at.tilt.along - c * against.along, -k * at.tilt.across - c * against.across}},
            axial * rate.axial +
                c * (against.along * rate.tilt.along + against.across * rate.tilt.across)};
}

// Add axial force and moments of bearing b to `force`; return the power lost to damping [W].
inline double tilt_bearing(const Train& train, std::int64_t b, double turning, const double* x,
                           const double* v, double* force) {
    const AxialTiltForce found = axial_tilt_force(train, b, turning, x, v);
    add_axial_tilt(train, b, found.reaction, force);
    return found.lost;
}

// Add the gyroscopic moments on the body on bearing b, which spins at `spin` [rad/s].
inline void add_gyroscopic(const Train& train, std::int64_t b, double turning, double spin,
                           const double* x, const double* v, double* force) {
    const TiltingAxis& own = train.moving.tilting[b];
    const double square = own.lever * own.lever;
    const double whirl = square * (2.0 * turning * own.diametral - own.polar * spin);
    const double restoring = square * turning * (turning * own.diametral - own.polar * spin);
    const std::int64_t first = own.place[0], second = own.place[1];
    force[first] += whirl * v[second] + restoring * x[first];
    force[second] += restoring * x[second] - whirl * v[first];
}

// Add the rows of the axial displacement and of the tilts across bearing b.
inline void add_tilting_rows(const Train& train, std::int64_t b, BearingRows& rows) {
    const TiltingAxis &own = train.moving.tilting[b],
                      &carrier = train.moving.tilting[CARRIER_BEARING];
    const bool carried = train.moving.carried[b] != 0.0;
    auto [cosine, sine] = train.moving.direction[b];
    const double lever = carried ? carrier.lever : 0.0, arm = train.moving.arm;
    const std::int64_t first = carrier.place[0], second = carrier.place[1];
    rows.add({false,
              4,
              {own.axial, carrier.axial, first, second},
              {1.0, carried ? -1.0 : 0.0, -arm * lever * sine, arm * lever * cosine},
              own.axial_stiffness,
              own.axial_damping});
    rows.add({false,
              3,
              {own.place[0], first, second},
              {own.lever, -lever * cosine, -lever * sine},
              own.tilting_stiffness,
              own.tilting_damping});
    rows.add({false,
              3,
              {own.place[1], first, second},
              {own.lever, lever * sine, -lever * cosine},
              own.tilting_stiffness,
              own.tilting_damping});
}

// Elastic energy of bearing b by axial displacement and tilts [J].
inline double axial_tilt_energy(const Train& train, std::int64_t b, const double* x) {
    const TiltingAxis& own = train.moving.tilting[b];
    const AxialTilt at = axial_tilt_across(train, b, x);
    double square = at.tilt.along * at.tilt.along + at.tilt.across * at.tilt.across;
    return 0.5 * (own.axial_stiffness * at.axial * at.axial + own.tilting_stiffness * square);
}

// Energy [J] of the inertial moments in the frame, like `centrifugal_energy` of the forces.
inline double tilting_energy(const Train& train, double turning, double spin, std::int64_t b,
                             const double* x) {
    const TiltingAxis& own = train.moving.tilting[b];
    const double first = own.lever * x[own.place[0]], second = own.lever * x[own.place[1]];
    return 0.5 * turning * (own.polar * spin - turning * own.diametral) *
           (first * first + second * second);
}

struct Rotation {
    double sine, cosine;
};

// Transform the tilts of the body on bearing b to another frame, see `turn_displacements`.
inline void turn_tilts(const Train& train, std::int64_t b, Rotation by, double rate, double* x,
                       double* v) {
    const std::int64_t first = train.moving.tilting[b].place[0];
    const std::int64_t second = train.moving.tilting[b].place[1];
    if (train.moving.carried[b] == 0.0) {
        double a = x[first], c = x[second], p = v[first], q = v[second];
        x[first] = by.cosine * a + by.sine * c;
        x[second] = by.cosine * c - by.sine * a;
        v[first] = by.cosine * p + by.sine * q;
        v[second] = by.cosine * q - by.sine * p;
    }
    v[first] += rate * x[second];
    v[second] -= rate * x[first];
}

// Axial displacement and tilts of the body on bearing b, and its axial force and moments on the
// bearing, six numbers.
inline void show_axial_tilt(const Train& train, std::int64_t b, double turning, const double* x,
                            const double* v, double* out) {
    const TiltingAxis& own = train.moving.tilting[b];
    const AxialTilt reaction = axial_tilt_force(train, b, turning, x, v).reaction;
    out[0] = x[own.axial];
    out[1] = own.lever * x[own.place[0]];
    out[2] = own.lever * x[own.place[1]];
    out[3] = -reaction.axial;
    out[4] = -reaction.tilt.along;
    out[5] = -reaction.tilt.across;
}

}  // namespace gearbox
