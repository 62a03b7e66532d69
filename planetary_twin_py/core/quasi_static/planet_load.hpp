#pragma once

// Load sharing of the planets: each is a spring with backlash between sun and ring.
//
// The transmission errors of a planet's two meshes add up to w = x_s + x_r - 2 x_c, for any motion
// of the planet (2 differs where ring != sun + 2 planet), so one wind-up w squeezes all planets.
// The force F on the ring and F + R on the sun (R: friction on the planet) are piecewise linear
// functions of w.

#include <algorithm>
#include <cstdint>

namespace gearbox {

struct alignas(64) Springs {
    alignas(64) double copies[16];  // number of planets with the same motion
    alignas(64) double error[16];   // of form, and compression of the sun mesh by `friction` [m]
    alignas(64) double compliance[16];  // of both meshes in series [m/N]
    alignas(64) double friction[16];    // friction on the planet [N]
    alignas(64) double steps[16][3];    // see `ring_force` [m]
};

// A force [N] and its growth with the wind-up [N/m].
struct SpringForce {
    double force;
    double growth;
};

// Force of a planet on the ring.
//
// w: wind-up minus errors of form and minus the compression of the sun mesh by `friction` [m].
// compliance: of both meshes in series [m/N].
// friction: friction on the planet [N].
// steps: clearance taken up with both meshes on the coast side, with one on each side, and with
// both on the drive side [m].
inline SpringForce ring_force(double w, double compliance, double friction, const double* steps) {
    // where one of the meshes is free of load
    double first = std::min(0.0, -friction), last = std::max(0.0, -friction);
    double growth = 1.0 / compliance;
    double force = (w - steps[2]) * growth;
    if (force > last) return {force, growth};
    force = (w - steps[1]) * growth;
    if (force > last) return {last, 0.0};
    if (force > first) return {force, growth};
    force = (w - steps[0]) * growth;
    if (force < first) return {force, growth};
    return {first, 0.0};
}

// A w [m] at which the planet has `force` on the ring: the inverse of `ring_force`.
inline double windup_at(double force, double compliance, double friction, const double* steps) {
    double first = std::min(0.0, -friction), last = std::max(0.0, -friction), step;
    if (force > last)
        step = steps[2];
    else if (force < first)
        step = steps[0];
    else if (first < force && force < last)
        step = steps[1];
    else if (first == last)
        step = 0.5 * (steps[0] + steps[2]);
    else
        step = 0.5 * (steps[1] + (force == last ? steps[2] : steps[0]));
    return compliance * force + step;
}

// Force of planet p on the ring at the wind-up w [m].
inline SpringForce planet_force(const Springs& springs, std::int64_t p, double w) {
    return ring_force(w - springs.error[p], springs.compliance[p], springs.friction[p],
                      springs.steps[p]);
}

// The wind-up w [m] at which the planets with their copies have `total` [N] on the ring.
double solve_windup(double total, std::int64_t planets, const Springs& springs);

}  // namespace gearbox
