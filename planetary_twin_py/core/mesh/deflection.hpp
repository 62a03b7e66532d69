#pragma once

// Transmission errors of the meshes from the motion of the bodies.

#include "mesh/form_errors.hpp"
#include "mesh/meshes_now.hpp"
#include "model/step_constants.hpp"
#include "model/train.hpp"

namespace gearbox {

// Transmission error of mesh i from x, its rate from v.
inline double mesh_motion(const Train& train, std::int64_t i, const double* x) {
    double total = 0.0;
    for (int j = 0; j < entries_of(train); ++j)
        total += train.mesh.sign[i][j] * x[train.mesh.body[i][j]];
    return total;
}

// Transmission errors and their rates from the motion of the bodies.
inline void move_meshes(const Train& train, const double* x, const double* v, MeshesNow& now) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        now.d[i] = mesh_motion(train, i, x);
        now.rate[i] = mesh_motion(train, i, v);
    }
}

struct Deflection {
    double d, rate, error_rate;  // d - e [m], its rate [m/s], the rate of e [m/s]
};

// d - e of mesh i on the side of `step`, `advance` mesh cycles after its start.
inline Deflection deflection(const Train& train, const StepConstants& step, std::int64_t i,
                             const double* x, const double* v, double advance, double cycle_rate) {
    double d = mesh_motion(train, i, x), rate = mesh_motion(train, i, v);
    if (train.errors.lines[train.mesh.kind[i]] == 0) return {d, rate, 0.0};
    LengthAndRate e = form_error(train, i, step.side[i], step.line_angle, advance, cycle_rate);
    return {d - e.length, rate - e.rate, e.rate};
}

}  // namespace gearbox
