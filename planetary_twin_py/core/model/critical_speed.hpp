#pragma once

// Equilibrium of moving axes above a critical speed.
//
// There linear bearings yield to centrifugal forces: the stiffness of springs less that of these
// forces is not positive definite, but the centred equilibrium remains, and Coriolis forces can
// make it stable.

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "capacities.hpp"
#include "lubrication/tooth_friction.hpp"
#include "model/bearings.hpp"
#include "model/train.hpp"
#include "vector/cholesky.hpp"

namespace gearbox {

// Subtract from `stiffness` that of the centrifugal forces of `add_inertial`.
inline void soften(const Train& train, double turning, Matrix stiffness) {
    const MovingAxes& axes = train.moving;
    const double along[] = {1.0};
    for (std::int64_t b = 0; b < axes.bearings; ++b) {
        const double softening = -axes.mass[b] * turning * turning;
        const std::int64_t beside[] = {axes.place[b][1], train.carrier};
        const double across[] = {1.0, -axes.carried[b]};
        add_outer(stiffness, axes.place[b], along, 1, softening);
        add_outer(stiffness, beside, across, 2, softening);
    }
}

// Replace b (n,) by the solution of a x = b, by elimination with pivots; changes a.
inline void eliminate(Matrix a, std::int64_t n, double* b) {
    for (std::int64_t j = 0; j < n; ++j) {
        std::int64_t pivot = j;
        for (std::int64_t i = j + 1; i < n; ++i)
            if (std::fabs(a[i][j]) > std::fabs(a[pivot][j])) pivot = i;
        std::swap(b[j], b[pivot]);
        for (std::int64_t k = j; k < n; ++k) std::swap(a[j][k], a[pivot][k]);
        for (std::int64_t i = j + 1; i < n; ++i) {
            const double factor = a[i][j] / a[j][j];
            for (std::int64_t k = j; k < n; ++k) a[i][k] -= factor * a[j][k];
            b[i] -= factor * b[j];
        }
    }
    for (std::int64_t i = n - 1; i >= 0; --i) {
        for (std::int64_t k = i + 1; k < n; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
}

// Replace `force` by the displacement of springs and centrifugal forces if the speed [rad/s] is
// above a critical one of linear bearings; whether it is.
inline bool displace_above_critical_speed(const Train& train, double turning,
                                          const double (*stiffness)[BODIES], double* force) {
    if (turning == 0.0) return false;
    for (std::int64_t b = 0; b < train.moving.bearings; ++b)
        if (!is_linear(train.moving, b)) return false;
    alignas(64) double softened[BODIES][BODIES], factor[BODIES][BODIES];
    std::memcpy(softened, stiffness, sizeof softened);
    soften(train, turning, softened);
    std::memcpy(factor, softened, sizeof factor);
    factorise(factor, train.bodies);
    bool definite = true;  // then each pivot has a root
    for (std::int64_t j = 0; j < train.bodies; ++j) definite &= std::isfinite(factor[j][j]);
    if (!definite) eliminate(softened, train.bodies, force);
    return !definite;
}

}  // namespace gearbox
