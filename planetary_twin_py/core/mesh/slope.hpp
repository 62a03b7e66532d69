#pragma once

// Tilting of the flanks of a mesh against each other.
//
// Where gears tilt, the deflection of their flanks changes along the face by a slope s. Each part
// of the face has its share of the stiffness k of the mesh, so in addition to the force at the
// middle there is a moment k L^2/12 s, and the energy k L^2 s^2/24, with the face width L. The face
// is taken as touching all along.

#include "capacities.hpp"
#include "mesh/meshes_now.hpp"
#include "model/step_constants.hpp"
#include "model/tilting.hpp"
#include "model/train.hpp"

namespace gearbox {

// Slope of mesh i [rad] from x, its rate from v.
inline double slope_of(const Train& train, std::int64_t i, const double* x) {
    if (!tilts(train)) return 0.0;
    const MovingAxes& axes = train.moving;
    double slope = 0.0;
    for (int j = 0; j < SLOPES; ++j) slope += axes.slope[i][j] * x[axes.slope_place[i][j]];
    return slope;
}

// Moments against the slopes of all meshes, whose forces are known, and their powers.
inline void tilt_flanks(const Train& train, const StepConstants& step, const double* x,
                        const double* v, MeshesNow& now) {
    const double face = train.moving.face_square;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        now.moment[i] = 0.0;
        if (step.side[i] == 0.0) continue;
        const double k = face * now.stiffness[i],
                     c = k * (step.fixed_damping_time[i] + now.speed_damping_time);
        const double slope = slope_of(train, i, x), rate = slope_of(train, i, v);
        now.moment[i] = k * slope + c * rate;
        now.damping_power[i] += c * rate * rate;
        now.stiffness_power[i] += 0.5 * face * now.stiffening[i] * slope * slope;
    }
}

// Add what a moment against the slope of mesh i and its copies does to the tilts.
inline void add_slope_moment(const Train& train, std::int64_t i, double moment, double* force) {
    if (!tilts(train)) return;
    const MovingAxes& axes = train.moving;
    for (int j = 0; j < SLOPES; ++j)
        force[axes.slope_place[i][j]] -= train.mesh.copies[i] * moment * axes.slope[i][j];
}

// Add the moments against the slopes of all meshes.
inline void add_slope_moments(const Train& train, const MeshesNow& now, double* force) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        if (now.moment[i] != 0.0) add_slope_moment(train, i, now.moment[i], force);
}

// Add the stiffness against the slope of mesh i, whose flanks have the stiffness k [N/m].
inline void add_slope_stiffness(const Train& train, std::int64_t i, double k,
                                double (*stiffness)[BODIES]) {
    if (!tilts(train)) return;
    const MovingAxes& axes = train.moving;
    for (int a = 0; a < SLOPES; ++a)
        for (int b = 0; b < SLOPES; ++b)
            stiffness[axes.slope_place[i][a]][axes.slope_place[i][b]] +=
                k * axes.face_square * axes.slope[i][a] * axes.slope[i][b];
}

// Elastic energy of the slope of mesh i [J] with the stiffness k [N/m].
inline double slope_energy(const Train& train, std::int64_t i, double k, const double* x) {
    const double slope = slope_of(train, i, x);
    return 0.5 * k * train.moving.face_square * slope * slope;
}

}  // namespace gearbox
