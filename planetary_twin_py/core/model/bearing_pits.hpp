#pragma once

// Pits in rolling bearings: the element that passes a pit loses depth of deflection.
//
// Without pits the force of a bearing is a mean over the positions of its cage, see
// `rolling_bearing.hpp`. A pit adds what one element loses. Pressed together by d, the element at
// the angle phi of the bearing stores K d^(n + 1)/(n + 1); where the pit takes q of d, it stores
// K (d - q)^(n + 1)/(n + 1). The difference depends on the eccentricity and on the angle of the
// body against its support, from which cage and pit follow without slip. Its derivatives are a
// force and a torque, so what the element loses in the pit the shafts give back as it leaves.
//
// With g = roller over pitch diameter and an inner race at rest, the cage turns by (1 + g)/2 of the
// outer race; with an outer race at rest, by (1 - g)/2 of the inner one. A roller turns against the
// cage by (1 - g^2)/(2 g) of the relative turn, and its pit meets either race in half a turn.

#include <cmath>
#include <limits>
#include <numbers>

#include "capacities.hpp"
#include "model/counted_angle.hpp"
#include "model/state.hpp"
#include "model/train.hpp"
#include "model/weight.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Parts of a bearing with a pit: its cage, and the race or the roller with the pit.
constexpr int CAGE = 0, PIT = 1;

// What a bearing with a pit has in addition to its mean force.
struct PitEffect {
    double energy;   // [J], not above 0
    InPlane force;   // on the body [N]
    double torque;   // on the body against its support [N m]
    double turning;  // growth of the energy by the turn of the support's frame [J/rad]
};

// Angles of a pit, `delay` seconds after a state.
struct PitPlace {
    double element;  // of the element that is nearest to the pit [rad]
    double past;     // of the element past the pit, or of the pit of a roller past a race [rad]
};

// Angle of part `part` of a pit: of the cage, or of the pit itself.
inline double angle_of_part(const State& state, const BearingPit& pit, int part, double delay,
                            double twist) {
    const double turned = counted_angle(state, pit.numerator[part], pit.denominator[part],
                                        pit.per_motor[part], delay);
    return pit.start[part] + turned + pit.per_turn[part] * twist;
}

// Turn of the body against its support beyond that of the motors [rad], from x; its rate from v.
inline double twist_of(const Train& train, const BearingPit& pit, const double* x) {
    double twist = x[pit.body] * train.body.inverse_radius[pit.body];
    if (train.moving.carried[pit.bearing] != 0.0)
        twist -= x[train.carrier] * train.body.inverse_radius[train.carrier];
    return twist;
}

// Angle between two places at which the pit takes effect [rad].
inline double period_of(const BearingPit& pit) {
    return pit.roller ? std::numbers::pi : 2.0 * std::numbers::pi / pit.count;
}

inline PitPlace place_of_pit(const Train& train, const State& state, const BearingPit& pit,
                             double delay, const double* x) {
    const double twist = twist_of(train, pit, x), period = period_of(pit);
    const double cage = angle_of_part(state, pit, CAGE, delay, twist),
                 own = angle_of_part(state, pit, PIT, delay, twist);
    const double ahead = pit.roller ? own : cage - own;
    const double past = ahead - period * std::nearbyint(ahead / period);
    return {pit.roller ? cage : own + past, past};
}

// Rate of `past` per turn of the body against its support.
inline double passing_per_turn(const BearingPit& pit) {
    return pit.roller ? pit.per_turn[PIT] : pit.per_turn[CAGE] - pit.per_turn[PIT];
}

// Effect of a pit, from the displacement of the body on its bearing from the centred position.
inline PitEffect pit_effect(const MovingAxes& axes, const BearingPit& pit, const PitPlace& at,
                            const InPlane& displacement) {
    const double s = at.past / pit.half_width, open = 1.0 - s * s;
    if (!(open > 0.0) || pit.depth == 0.0) return {};
    const bool carried = axes.carried[pit.bearing] != 0.0;
    const double towards = carried ? -1.0 : 1.0;  // a planet is outside its elements
    auto [sine, cosine] = sin_cos(at.element);
    const double deflection = towards * (displacement.along * cosine + displacement.across * sine) -
                              axes.clearance[pit.bearing];
    if (!(deflection > 0.0)) return {};
    const double lost = pit.depth * open * open;
    const double deepening = -4.0 * pit.depth * open * s / pit.half_width;
    const double left = std::fmax(deflection - lost, 0.0), n = pit.exponent;
    const double whole_force = pit.strength * power(deflection, n),
                 force = left > 0.0 ? pit.strength * power(left, n) : 0.0;
    const double missing = whole_force - force;
    const double along_race =
        towards * (displacement.across * cosine - displacement.along * sine);  // d deflection/d phi
    return {(force * left - whole_force * deflection) / (n + 1.0),
            {towards * missing * cosine, towards * missing * sine},
            missing * along_race * pit.per_turn[CAGE] + force * deepening * passing_per_turn(pit),
            carried ? 0.0 : missing * along_race};
}

// Time [s] until a pit takes effect or ends to do so, or half of a passage if that is shorter.
inline double time_to_pit_edge(const Train& train, const State& state, const double* rigid) {
    constexpr double AT_EDGE = 1e-6;  // share of the half width within which a pit is entered
    double nearest = std::numeric_limits<double>::infinity();
    for (std::int64_t k = 0; k < train.moving.pits; ++k) {
        const BearingPit& pit = train.moving.pit[k];
        if (pit.depth == 0.0) continue;
        double turning = rigid[pit.body];
        if (train.moving.carried[pit.bearing] != 0.0) turning -= rigid[train.moving.frame];
        const double rate = passing_per_turn(pit) * (turning + twist_of(train, pit, state.v));
        if (rate == 0.0) continue;
        const double past = std::copysign(1.0, rate) *
                            place_of_pit(train, state, pit, 0.0, state.x).past,
                     half = pit.half_width, margin = AT_EDGE * half;
        double way = period_of(pit) - half - past;
        if (past < half - margin) way = std::fmin(half, half - past);
        if (past < -half - margin) way = -half - past;
        nearest = std::fmin(nearest, way / std::fabs(rate));
    }
    return nearest;
}

}  // namespace gearbox
