#pragma once

// Static friction: before flanks slide, their contact is elastic.
//
// The elasto-plastic bristle of Dupont, Hayward, Armstrong and Altpeter 2002, Single state
// elastoplastic friction models, IEEE Transactions on Automatic Control 47, 787-792, eqs. (6), (7)
// and (10). Friction is a share z of the full friction of steady sliding, and z depends on the
// sliding V:
//
//     delta dz/dt = V (1 - a(z, V) z/z_s(V)),
//
// z_s the share in steady sliding, delta the presliding displacement. The bristle is elastic (a =
// 0) below a part of z_s, so a load that oscillates below break-away causes no permanent
// displacement; above it the contact becomes plastic until it slides (a = 1). While the flanks
// roll, z_s is the traction curve, and the equation also describes the replacement of bristles that
// leave the contact. The friction is that share with damping, z + RELAXATION dz/dt, of the full
// friction.

#include <cmath>
#include <numbers>

#include "vector/math.hpp"

namespace gearbox {

constexpr double ELASTIC = 0.7;  // part of the steady share below which there is no sliding
// Damping of the bristles over their stiffness [s], sigma_1/sigma_0 of the model: as in Canudas de
// Wit, Olsson, Astrom and Lischinsky 1995, it damps vibration on the bristles by about half the
// critical damping.
constexpr double RELAXATION = 2e-5;
constexpr double LEAST_STEADY = 1e-9;   // smaller shares: the layer is the inverse slope
constexpr double LEAST_SLOPE = 1e-300;  // [s/m]

struct PlasticShare {
    double part, growth;  // a of the model, and da/dz
};

// From the magnitudes of both shares.
inline PlasticShare plastic_share(double share, double steady) {
    double elastic = ELASTIC * steady;
    if (share <= elastic) return {0.0, 0.0};
    if (share >= steady) return {1.0, 0.0};
    double phase = std::numbers::pi / (steady - elastic);
    double angle = phase * (share - 0.5 * (steady + elastic));
    auto [sine, cosine] = sin_cos(angle);
    return {0.5 + 0.5 * sine, 0.5 * phase * cosine};
}

struct BristleRate {
    double rate;   // dz/dt [1/s]
    double decay;  // -d(dz/dt)/dz [1/s], not below zero
    double gain;   // d(dz/dt)/dV [1/m], not below zero
    double slip;   // the part of the sliding that dissipates, a V z/z_s [m/s]
};

// Rate of the share z [-] at the sliding V [m/s]; steady share z_s [-] at that speed, of its sign,
// its slope dz_s/dV [s/m], displacement delta [m].
inline BristleRate bristle_rate(double share, double sliding, double steady, double slope,
                                double displacement) {
    bool small = std::abs(steady) < LEAST_STEADY;
    double layer = small ? 1.0 / at_least(slope, LEAST_SLOPE) : sliding / steady;
    double curvature = small ? 0.0 : (1.0 - layer * slope) / steady;  // of that layer with V
    auto [part, growth] = plastic_share(std::abs(share), std::abs(steady));
    if (share * sliding < 0.0) part = growth = 0.0;
    double slip = part * layer * share;
    double decay = layer * (part + growth * std::abs(share)) / displacement;
    double gain = at_least(1.0 - part * share * curvature, 0.0) / displacement;
    return {(sliding - slip) / displacement, decay, gain, slip};
}

}  // namespace gearbox
