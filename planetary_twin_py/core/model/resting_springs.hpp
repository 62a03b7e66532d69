#pragma once

// The train as springs between bodies at rest in the frame of the motors: what the start of a run
// and quasi-static running with moving axes have in common.

#include <algorithm>

#include "lubrication/tooth_friction.hpp"
#include "mesh/deflection.hpp"
#include "mesh/slope.hpp"
#include "model/critical_speed.hpp"
#include "model/model.hpp"
#include "vector/cholesky.hpp"

namespace gearbox {

// Stiffness of the regularisation of free coordinates, relative to that of a tooth pair.
constexpr double REGULARISATION = 1e-9;

// Close the flanks that are compressed at x, where each has an entry; whether any contact changes.
inline bool touch_flanks(const Model& model, State& state, const StepConstants& step) {
    bool changes = false;
    for (std::int64_t i = 0; i < model.train.meshes; ++i) {
        const std::int64_t only = only_side(model.train, i);
        const auto side = static_cast<double>(only);
        const double error = form_error(model.train, i, side, step.line_angle, 0.0, 0.0).length;
        const double squeezed = side * (mesh_motion(model.train, i, state.x) - error);
        const std::int64_t found = squeezed > model.operation.backlash.offset ? only : OPEN;
        changes |= found != state.side[i];
        state.side[i] = found;
    }
    return changes;
}

// Add the stiffness k [N/m] of mesh i and its copies.
inline void add_mesh_stiffness(const Train& train, std::int64_t i, double k, Matrix stiffness) {
    add_outer(stiffness, train.mesh.body[i], train.mesh.sign[i], entries_of(train), k);
    add_slope_stiffness(train, i, k, stiffness);
}

// Add the stiffness of the couplings.
inline void add_coupling_stiffness(const Train& train, Matrix stiffness) {
    for (std::int64_t c = 0; c < train.machines; ++c)
        add_outer(stiffness, train.coupling.ends[c], ENDS, 2, train.coupling.stiffness[c]);
}

// Add a small stiffness to every coordinate: free ones, such as those of an axis that floats
// without load, do not move.
inline void regularise(const Train& train, Matrix stiffness) {
    const double least =
        REGULARISATION * std::max(train.teeth.stiffness[0], train.teeth.stiffness[1]);
    for (std::int64_t j = 0; j < train.bodies; ++j) stiffness[j][j] += least;
}

// Replace `force` by the displacement of the springs with fixed motors, in a frame that turns at
// `turning` [rad/s]; changes `stiffness`. Returns false above a critical speed.
inline bool displace_springs(const Train& train, double turning, Matrix stiffness, double* force) {
    for (std::int64_t a = 0; a < train.axes; ++a) {
        const std::int64_t motor = train.coupling.ends[2 * a][0];
        for (int j = 0; j < BODIES; ++j) stiffness[motor][j] = stiffness[j][motor] = 0.0;
        stiffness[motor][motor] = 1.0;
        force[motor] = 0.0;
    }
    if (displace_above_critical_speed(train, turning, stiffness, force)) return false;
    factorise(stiffness, train.bodies);
    solve(stiffness, train.bodies, force);
    return true;
}

}  // namespace gearbox
