#pragma once

// Quantities of the meshes at one instant that are published and recorded.

#include <cmath>
#include <cstring>
#include <limits>

#include "model/equations.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Fill out[:, i] for every mesh i from its transmission error `d`, its forces and its friction.
//
// Film and lambda ratio are means over the tooth pairs, weighted by load; NaN without contact.
// Friction forces are magnitudes.
template <int L>
ALWAYS_INLINE void show(const Model& model, const StepConstants& step, const double* d,
                        const MeshesNow& now, const MeshFriction& friction, double (*out)[MESHES]) {
    using V = Row<L>;
    const Oil& oil = model.oil;
    V side(step.side), force = larger(V(now.normal_force), V(0.0)), share(0.0);
    const Mask<L> open = side == 0.0;
    for (std::int64_t p = 0; p < model.train.teeth.slots; ++p) share += V(now.share[p]);
    V film(friction.film), lambda = film * exp(-oil.log_roughness);
    if (oil.prescribed) lambda = share * oil.lambda_ratio;
    constexpr double NONE = std::numeric_limits<double>::quiet_NaN();
    copy<L>(d, out[DTE]);
    (side * force).store(out[MESH_FORCE]);
    (force * (model.train.geometry.base_pitch * std::fabs(now.cycle_rate))).store(out[MESH_POWER]);
    select(open, NONE, film).store(out[FILM]);
    select(open, NONE, lambda).store(out[LAMBDA]);
    const double friction_acts = model.train.friction ? 1.0 : 0.0;
    (friction_acts * V(friction.boundary)).store(out[BOUNDARY]);
    (friction_acts * V(friction.viscous)).store(out[VISCOUS]);
    (friction_acts * V(friction.lost)).store(out[POWER_LOSS]);
}

// The same of a motion, without films if they are not wanted. `work` is work space.
inline void observe(const Model& model, const State& state, const StepConstants& step,
                    const double* x, const double* v, double delay, Evaluation& work,
                    double (*out)[MESHES], bool films = true) {
    alignas(64) double d[MESHES] = {};
    move_meshes(model.train, x, v, work.now);
    std::memcpy(d, work.now.d, sizeof d);
    mesh_forces(model, state, step, x, v, delay, work);
    find_friction_of_pairs(model, step, v, work);
    collect_parts(model.train, work.pairs, films, work.friction);
    with_mesh_lanes(model.train, [&]<int L>(std::integral_constant<int, L>) {
        show<L>(model, step, d, work.now, work.friction, out);
    });
}

}  // namespace gearbox
