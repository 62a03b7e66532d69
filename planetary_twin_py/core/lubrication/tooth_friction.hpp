#pragma once

// Friction of all loaded tooth pairs of the train in parallel.
//
// The pairs of all meshes form columns, for which the friction laws are evaluated in vector
// registers. Each friction force is applied as a generalised force Q_j = -f dVs/dw_j, which
// dissipates exactly f Vs, whichever members rotate or are fixed.

#include <algorithm>
#include <cmath>

#include "capacities.hpp"
#include "lubrication/bristles.hpp"
#include "lubrication/contact_heat.hpp"
#include "lubrication/mesh_friction.hpp"
#include "lubrication/tooth_contact.hpp"
#include "model/model.hpp"
#include "model/step_constants.hpp"
#include "vector/cholesky.hpp"

namespace gearbox {

// Least width of the range of sliding speeds in which friction reverses: that at this share of the
// rolling speed without vibration. If vibration stops the gears, the range would vanish and no step
// could resolve it.
constexpr double SLOWEST = 0.1;
constexpr double NARROWEST = 5e-3;     // slide-to-roll ratio: narrower reversals count as a step
constexpr double SLOWEST_TURN = 1e-3;  // [rad/s] below which the printed torque decreases to zero

// Rolling speed that sets the least width of the layer in which friction reverses [m/s].
inline double slowest_rolling(const Train& train, const StepConstants& step) {
    double rolling = SLOWEST * train.geometry.rolling_advance * std::abs(step.cycle_rate);
    return at_least(rolling, SLOWEST_ROLLING);
}

// Speed at which the displacements of the gears turn the line of action of mesh i [rad/s], from v.
inline double turning_of_line(const Train& train, std::int64_t i, const double* v) {
    double turning = 0.0;
    for (int j = GEARS; j < IN_PLANE; ++j)
        turning += train.moving.line[i][j] * v[train.mesh.body[i][j]];
    return turning;
}

// Speeds of the gears of all pairs relative to the carrier, and to the line of action if that
// rotates.
inline void turn_pairs(const Train& train, const StepConstants& step, const double* v,
                       ToothPairs& pairs) {
    std::int64_t meshes = train.meshes;
    pairs.slowest_rolling = slowest_rolling(train, step);
    double turn[BODIES];  // speeds of the bodies [rad/s]
    for (int j = 0; j < BODIES; ++j) turn[j] = step.rigid[j] + v[j] * train.body.inverse_radius[j];
    for (std::int64_t i = 0; i < meshes; ++i) {
        double frame = turn[train.mesh.body[i][2]];
        if constexpr (MOVING) frame += turning_of_line(train, i, v);
        double speed1 = turn[train.mesh.body[i][0]] - frame,
               speed2 = turn[train.mesh.body[i][1]] - frame;
        for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
            pairs.speed1[p * meshes + i] = speed1;
            pairs.speed2[p * meshes + i] = speed2;
        }
    }
}

// Range of sliding speeds [m/s] in which friction reverses at the pitch point.
//
// Both flanks roll there at r sin(alpha) w = tan(alpha) p_b f_m, in both kinds of mesh.
inline double friction_layer(const Train& train, const Oil& oil, double cycle_rate) {
    double rolling = train.geometry.rolling_advance * std::abs(cycle_rate);
    return at_least(oil.sliding_threshold, NARROWEST) * at_least(rolling, CREEPING);
}

// Film and friction of `pairs.count` pairs.
void evaluate(const Model& model, ToothPairs& pairs);

// Power dissipated by the friction of pair k [W].
inline double dissipated(const ToothPairs& pairs, std::int64_t k) {
    return pairs.has_bristles ? pairs.lost[k] : pairs.friction[k] * pairs.sliding[k];
}

// Power that deforms the bristles of all meshes elastically [W]: work of friction that is not lost.
inline double deforming_power(const Train& train, const ToothPairs& pairs) {
    if (!pairs.has_bristles) return 0.0;
    double power = 0.0;
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        double work = pairs.friction[k] * pairs.sliding[k];
        power += train.mesh.copies[k % train.meshes] * (work - pairs.lost[k]);
    }
    return power;
}

// Add up the torques of the pairs of each mesh: -f dVs/dw and -F_R d(u1 + u2)/dw of both gears, u1
// and u2 the surface speeds.
inline void collect(const Train& train, const ToothPairs& pairs, MeshFriction& found) {
    DragOfMeshes& out = found.drag;
    for (std::int64_t i = 0; i < train.meshes; ++i)
        out.torque[0][i] = out.torque[1][i] = out.power[i] = 0.0;
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            std::int64_t k = p * train.meshes + i;
            double f = pairs.friction[k], rolling = pairs.rolling[k];
            out.torque[0][i] -= (f + rolling) * pairs.rho1[k];
            out.torque[1][i] -= (f - rolling) * pairs.external[k] * pairs.rho2[k];
            out.power[i] += dissipated(pairs, k) + pairs.rolling_power[k];
        }
    }
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        out.torque[2][i] = -(out.torque[0][i] + out.torque[1][i]);
        found.lost[i] = out.power[i];
    }
}

// Add up the parts of friction of the pairs of each mesh, and their films weighted by load, if
// `films`; else these are zero.
inline void collect_parts(const Train& train, const ToothPairs& pairs, bool films,
                          MeshFriction& found) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        found.boundary[i] = found.viscous[i] = found.film[i] = 0.0;
    for (std::int64_t p = 0; p < train.teeth.slots; ++p) {
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            std::int64_t k = p * train.meshes + i;
            found.boundary[i] += pairs.boundary[k];
            found.viscous[i] += pairs.viscous[k];
            if (films)
                found.film[i] += pairs.share[k] * at_least(exp(pairs.log_film[k]), THINNEST_FILM);
        }
    }
}

// Highest flash temperature and thinnest film of each mesh, from the friction of its pairs.
COLD inline void find_heat_of_pairs(const Train& train, const Oil& oil, const ToothPairs& pairs,
                                    MeshFriction& found) {
    std::fill_n(found.flash, MESHES, 0.0);
    std::fill_n(found.per_film, MESHES, 0.0);
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        const std::int64_t i = k % train.meshes;
        const double rho1 = pairs.rho1[k], rho2 = pairs.rho2[k], external = pairs.external[k];
        const double face = pairs.face[k] > 0.0 ? pairs.face[k] : 1.0, load = pairs.load[k] / face;
        const auto [sliding, sum] =
            surface_speeds(rho1, rho2, external, pairs.speed1[k], pairs.speed2[k]);
        const double radius = rho1 * rho2 / distance_of(rho1, rho2, external) * oil.line_length;
        const double friction = pairs.friction[k] / (face * oil.line_length);
        found.flash[i] = at_least(found.flash[i], flash_temperature(train.durability.heat, friction,
                                                                    sliding, sum, radius, load));
        found.per_film[i] = at_least(
            found.per_film[i], inverse_film(at_least(exp(pairs.log_film[k]), THINNEST_FILM), load));
    }
}

// Friction torque as Salagianni et al. 2017 print it.
//
// T = P/w (17) on both gears, with the sign of (18)-(20): it drives every gear in its direction of
// rotation, and so supplies twice the power that is lost. Divided by (w^2 + w0^2)/w, since at rest
// P/w is 0/0. Replaces the result of `collect`.
inline void print_torques(const Train& train, const StepConstants& step, const double* v,
                          DragOfMeshes& out) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double lost = out.power[i], power = 0.0;
        for (int gear = 0; gear < 2; ++gear) {
            std::int64_t body = train.mesh.body[i][gear];
            double speed = step.rigid[body] + v[body] * train.body.inverse_radius[body];
            double torque = lost * speed / (speed * speed + SLOWEST_TURN * SLOWEST_TURN);
            out.torque[gear][i] = torque;
            power -= torque * speed;
        }
        out.torque[2][i] = 0.0;
        out.power[i] = power;
    }
}

// Fill dVs/dv (IN_PLANE,) of pair k for the coordinates of its mesh.
inline void sliding_row(const Train& train, const ToothPairs& pairs, std::int64_t k, double* row) {
    std::int64_t i = k % train.meshes;
    double rho1 = pairs.rho1[k], rho2 = pairs.external[k] * pairs.rho2[k];
    row[0] = rho1 * train.mesh.lever[0][i];
    row[1] = rho2 * train.mesh.lever[1][i];
    row[2] = -(rho1 + rho2) * train.mesh.lever[2][i];
    for (int j = GEARS; j < IN_PLANE; ++j) row[j] = -(rho1 + rho2) * train.moving.line[i][j];
}

constexpr double ENDS[2] = {1.0, -1.0};  // of a shaft, in its twist

// matrix[body, body] += factor * row row^T, of the `size` bodies.
inline void add_outer(Matrix matrix, const std::int64_t* body, const double* row, int size,
                      double factor) {
    for (int a = 0; a < size; ++a)
        for (int b = 0; b < size; ++b) matrix[body[a]][body[b]] += factor * row[a] * row[b];
}

// Add the damping by friction, slope dVs/dv dVs/dv^T, to `matrix`.
//
// It is large at small sliding speeds: at the pitch point, and for all pairs near standstill. Where
// the forces on the bodies would reverse the sliding within h seconds, the slope is that of the
// chord to rest: with the much smaller tangent, each step would reverse the sliding. `row`
// (IN_PLANE,) is work space.
inline void friction_damping(const Train& train, const ToothPairs& pairs, const double* force,
                             double h, double* row, Matrix matrix) {
    for (std::int64_t k = 0; k < pairs.count; ++k) {
        std::int64_t i = k % train.meshes;
        sliding_row(train, pairs, k, row);
        double sliding = pairs.sliding[k], slope = pairs.slope[k], gain = 0.0;
        for (int j = 0; j < IN_PLANE; ++j) {
            std::int64_t body = train.mesh.body[i][j];
            gain += h * row[j] * force[body] / train.body.mass[body];
        }
        if (sliding * (sliding + gain) < 0.0) slope = at_least(slope, pairs.friction[k] / sliding);
        add_outer(matrix, train.mesh.body[i], row, IN_PLANE, train.mesh.copies[i] * slope);
    }
}

// Copy the inputs of `friction_damping`.
inline void copy_friction(const ToothPairs& source, ToothPairs& target) {
    target.count = source.count;
    for (auto column : {&ToothPairs::rho1, &ToothPairs::rho2, &ToothPairs::external,
                        &ToothPairs::friction, &ToothPairs::sliding, &ToothPairs::slope})
        std::copy_n(source.*column, source.count, target.*column);
    if (!source.has_bristles) return;
    for (auto column : {&ToothPairs::bristle, &ToothPairs::full, &ToothPairs::bristle_rate,
                        &ToothPairs::bristle_decay, &ToothPairs::bristle_gain})
        std::copy_n(source.*column, PAIR_CAPACITY, target.*column);
}

}  // namespace gearbox
