#include "model/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "lubrication/bristles.hpp"
#include "mesh/deflection.hpp"
#include "mesh/form_errors.hpp"
#include "mesh/slope.hpp"
#include "mesh/stiffness.hpp"
#include "model/axes_forces.hpp"
#include "model/equations.hpp"
#include "model/resting_springs.hpp"
#include "model/set_step_constants.hpp"

namespace gearbox {

namespace {

constexpr int CYCLE_POINTS = 64;      // places in the mesh cycle over which friction is averaged
constexpr int BALANCING_PASSES = 12;  // each reduces the error of friction to some per cent
constexpr int WHOLE_PASSES = 30;      // of whole steps, after which contacts might alternate
constexpr int SHORT_PASSES = 200;     // of steps that are shortened then
constexpr int MOST_HALVINGS = 40;     // of such a step
constexpr double AT_REST = 1e-13;     // [m] allowed change of the axes by a pass
constexpr int SETTLING_PASSES = 3;  // the first finds the wind-up of the couplings, the others the
                                    // tooth pairs there

// Work space for the equilibrium of a train.
struct Start {
    const Model& model;
    double mesh_force;  // mean force of every mesh [N]
    State& state;
    StepConstants step;
    alignas(64) double stiffness[BODIES][BODIES];  // linearised springs at `state` [N/m]
    alignas(64) double force[BODIES];              // on them [N]
    Evaluation evaluation;
};

// Stiffness of bearing b in any direction: at least that along its load.
double stiffest(const Train& train, std::int64_t b, const double* x) {
    const MovingAxes& axes = train.moving;
    if (!rolls(axes, b)) return axes.stiffness[b];
    return std::max(axes.stiffness[b], bearing_law(axes, b, eccentricity(train, b, x)).stiffness);
}

// Add the stiffness of the bearings, neglecting clearances, which limits the length of steps at the
// cost of more of them.
void add_bearing_stiffness(Start& start) {
    const Train& train = start.model.train;
    for (std::int64_t b = 0; b < train.moving.bearings; ++b) {
        const double radial = stiffest(train, b, start.state.x);
        for (const BearingRow& row : rows_of_bearing(train, b))
            add_outer(start.stiffness, row.place, row.factor, row.size,
                      row.radial ? radial : row.stiffness);
    }
}

// Move x by the displacement of the springs under `force`, with fixed motors.
void displace_by_forces(Start& start) {
    const Train& train = start.model.train;
    std::fill(&start.stiffness[0][0], &start.stiffness[0][0] + BODIES * BODIES, 0.0);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double k = mesh_stiffness(train, i, start.state.segment[i], start.step.start[i]);
        if (MOVING && start.state.side[i] == OPEN) continue;
        add_mesh_stiffness(train, i, train.mesh.copies[i] * k, start.stiffness);
    }
    add_coupling_stiffness(train, start.stiffness);
    if constexpr (MOVING) {
        add_bearing_stiffness(start);
        regularise(train, start.stiffness);
    }
    const double turning = MOVING ? start.step.rigid[train.moving.frame] : 0.0;
    displace_springs(train, turning, start.stiffness, start.force);
    for (std::int64_t j = 0; j < train.bodies; ++j) start.state.x[j] += start.force[j];
}

// Forces on every body at x, at rest in the frame; into `force`.
//
// Where axes are fixed, less the mean loads of meshes and couplings, which are in equilibrium:
// there are more meshes than bodies, so all of them carry the mean force only if all are equally
// stiff.
void forces_at_rest(Start& start) {
    const Train& train = start.model.train;
    const Operation& operation = start.model.operation;
    const State& state = start.state;
    double* force = start.force;
    std::fill(force, force + BODIES, 0.0);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (state.side[i] == OPEN) continue;
        double k = mesh_stiffness(train, i, state.segment[i], start.step.start[i]);
        double d = deflection(train, start.step, i, state.x, state.v, 0.0, 0.0).d;
        double normal_force =
            k * (d - static_cast<double>(state.side[i]) * operation.backlash.offset);
        if (!MOVING) normal_force -= start.mesh_force;
        for (int j = 0; j < entries_of(train); ++j)
            force[train.mesh.body[i][j]] -=
                train.mesh.copies[i] * train.mesh.sign[i][j] * normal_force;
        add_slope_moment(train, i, k * train.moving.face_square * slope_of(train, i, state.x),
                         force);
    }
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t machine = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        double drive = operation.torque[c] / train.body.radius[machine];
        double wound = train.coupling.stiffness[c] * (state.x[machine] - state.x[member]);
        force[machine] += drive - wound;
        force[member] += MOVING ? wound : wound - drive;
    }
    if constexpr (MOVING) {
        double power[LEDGER] = {};
        apply_axes(train, state, start.step.rigid, 0.0, state.x, state.v, force, power);
    }
    for (std::int64_t a = 0; a < train.axes; ++a) force[train.coupling.ends[2 * a][0]] = 0.0;
}

// Force along a step of the bodies [N m].
double along(const Start& start, const double* step) {
    return std::inner_product(step, step + start.model.train.bodies, start.force, 0.0);
}

// Find contacts and forces at x; return whether contacts of flanks have changed.
bool find_forces(Start& start) {
    find_tooth_pairs(start.model, start.state, start.step);
    const bool changes = touch_flanks(start.model, start.state, start.step);
    if (changes) find_tooth_pairs(start.model, start.state, start.step);
    forces_at_rest(start);
    return changes;
}

// Halve a step from `before` until the forces at its end push back less than half as hard as those
// at its start pulled, by `pull` [N m]. The energy of the springs is convex, so such steps end at
// its minimum, also if a body floats between open flanks, where whole steps have no limit.
//
// Return whether contacts of flanks have changed.
bool shorten(Start& start, const double* before, double* step, double pull) {
    const std::int64_t bodies = start.model.train.bodies;
    bool changes = find_forces(start);
    for (int n = 0; n < MOST_HALVINGS && along(start, step) < -0.5 * pull; ++n) {
        for (std::int64_t j = 0; j < bodies; ++j) {
            step[j] *= 0.5;
            start.state.x[j] = before[j] + step[j];
        }
        pull *= 0.5;
        changes |= find_forces(start);
    }
    return changes;
}

// Move x to the equilibrium of unilateral flanks and bearings with clearance under the mean
// torques: Newton's method, which is exact once the contacts are known (see statics/statics.py).
//
// Return whether it is found.
bool newton(Start& start, int passes, bool shortened) {
    const std::int64_t bodies = start.model.train.bodies;
    double before[BODIES], step[BODIES];
    find_tooth_pairs(start.model, start.state, start.step);
    forces_at_rest(start);
    bool changes = false;
    for (int pass = 0; pass < passes; ++pass) {
        std::copy_n(start.state.x, bodies, before);
        std::copy_n(start.force, bodies, step);
        displace_by_forces(start);
        double pull = 0.0, moved = 0.0;
        for (std::int64_t j = 0; j < bodies; ++j) {
            const double force = step[j];
            step[j] = start.state.x[j] - before[j];
            pull += force * step[j];
        }
        const bool touched = shortened && shorten(start, before, step, pull);
        for (std::int64_t j = 0; j < bodies; ++j)
            moved = std::max(moved, std::fabs(start.state.x[j] - before[j]));
        if (pass > 0 && !changes && moved < AT_REST) return true;
        changes = find_forces(start) || touched;
    }
    return false;
}

// Whole steps are fewer, where they lead to the equilibrium.
bool balance_axes(Start& start) {
    const State first = start.state;
    if (newton(start, WHOLE_PASSES, false)) return true;
    start.state = first;
    return newton(start, SHORT_PASSES, true);
}

// Write the largest force on a body at rest at x to `found`: zero in equilibrium.
void find_unbalanced(Start& start, InitialState& found) {
    touch_flanks(start.model, start.state, start.step);
    find_tooth_pairs(start.model, start.state, start.step);
    forces_at_rest(start);
    for (std::int64_t j = 0; j < start.model.train.bodies; ++j) {
        const double force = std::fabs(start.force[j]);
        if (force <= found.unbalanced) continue;
        found.unbalanced = force;
        found.body = j;
    }
}

// Choose x so that every mesh and coupling carries its mean load at the present motor angle.
//
// The wind-up of the couplings is a considerable part of a mesh cycle, and moves the tooth pairs,
// on whose stiffness the deflections of the meshes depend. Returns whether they do.
bool balance_at_angle(Start& start) {
    if constexpr (MOVING) return balance_axes(start);
    for (int n = 0; n < SETTLING_PASSES; ++n) {
        find_tooth_pairs(start.model, start.state, start.step);
        forces_at_rest(start);
        displace_by_forces(start);
    }
    find_tooth_pairs(start.model, start.state, start.step);
    return true;
}

// Write the static forces, without the inertia of a speed ramp, to `evaluation`.
void forces_at_constant_speed(const Model& model, Start& start) {
    State& state = start.state;
    std::fill(start.step.slew, start.step.slew + AXES, 0.0);
    place_drives(model, state, start.step);
    forces(model, state, start.step, state.x, state.v, 0.0, state.trim, start.evaluation);
}

// Torque against the rigid motion of a motor [N m].
double drag(const Start& start, std::int64_t axis) {
    const Train& train = start.model.train;
    double total = 0.0;
    for (std::int64_t j = 0; j < train.bodies; ++j)
        total -= train.body.ratio[axis][j] * start.evaluation.force[j] * train.body.radius[j];
    return total;
}

// Drag of each motor's motion by friction in equilibrium: a mean over a mesh cycle from motor angle
// zero, at which `state` is left. Angles at which no equilibrium is found do not count.
void mean_drag(Start& start, double* drags) {
    const Train& train = start.model.train;
    std::fill(drags, drags + AXES, 0.0);
    int found = 0;
    for (int point = 0; point < CYCLE_POINTS; ++point) {
        start.state.fraction[0] = point / (CYCLE_POINTS * std::abs(train.cycle.per_turn[0]));
        if (!balance_at_angle(start)) continue;
        ++found;
        forces_at_constant_speed(start.model, start);
        for (std::int64_t a = 0; a < train.axes; ++a) drags[a] += drag(start, a);
    }
    for (std::int64_t a = 0; a < train.axes; ++a) drags[a] /= std::max(found, 1);
    start.state.fraction[0] = 0.0;
}

// Set the sides of the meshes from the gaps of their flanks: errors of form beyond the deflection
// separate them.
void choose_sides(Start& start) {
    const Train& train = start.model.train;
    double half = start.model.operation.backlash.half;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double side = static_cast<double>(start.state.side[i]);
        double d = mesh_motion(train, i, start.state.x);
        double own = form_error(train, i, side, start.step.line_angle, 0.0, 0.0).length;
        if (side * (d - own) >= half) continue;
        double other = form_error(train, i, -side, start.step.line_angle, 0.0, 0.0).length;
        start.state.side[i] = side * (other - d) <= half ? OPEN : -start.state.side[i];
    }
    find_tooth_pairs(start.model, start.state, start.step);
}

// Move x to the equilibrium of all forces with friction, for gears that creep.
//
// The motors stand still. Fills the unbalanced torques along the motion of each.
void balance_friction(Start& start, double* drags) {
    forces_at_constant_speed(start.model, start);
    const double* force = start.evaluation.force;
    std::copy(force, force + BODIES, start.force);
    displace_by_forces(start);
    find_tooth_pairs(start.model, start.state, start.step);
    forces_at_constant_speed(start.model, start);
    for (std::int64_t a = 0; a < start.model.train.axes; ++a) drags[a] = drag(start, a);
}

// Set the trim of the speed loop so that the machines balance the drag along each rigid motion.
void trim(const Model& model, const double* drags, State& state) {
    const Train& train = model.train;
    double effect[AXES][AXES] = {};  // torque along motion a per trim b
    for (std::int64_t c = 0; c < train.machines; ++c)
        for (std::int64_t a = 0; a < train.axes; ++a)
            for (std::int64_t b = 0; b < train.axes; ++b)
                effect[a][b] += train.body.ratio[a][train.coupling.ends[c][0]] *
                                model.operation.trim_gain[c][b];
    if (train.axes == 1 || effect[0][0] == 0.0 || effect[1][1] == 0.0) {
        for (std::int64_t a = 0; a < train.axes; ++a)
            if (effect[a][a] != 0.0) state.trim[a] += drags[a] / effect[a][a];
        return;  // no machine controls the other speeds
    }
    double determinant = effect[0][0] * effect[1][1] - effect[0][1] * effect[1][0];
    state.trim[0] += (drags[0] * effect[1][1] - drags[1] * effect[0][1]) / determinant;
    state.trim[1] += (drags[1] * effect[0][0] - drags[0] * effect[1][0]) / determinant;
}

bool is_closed(const Train& train, const State& state) {
    return std::all_of(state.side, state.side + train.meshes,
                       [](std::int64_t side) { return side != OPEN; });
}

}  // namespace

InitialState initial_state(const Model& model, const double* speed, double force) {
    const Train& train = model.train;
    InitialState found{};
    State& state = found.state;
    std::copy(speed, speed + AXES, state.speed);
    std::copy(speed, speed + AXES, state.set_speed);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        const std::int64_t side = force >= 0.0 ? DRIVE_SIDE : COAST_SIDE,
                           only = only_side(train, i);
        state.side[i] = only == OPEN || only == side ? side : OPEN;
    }
    auto steady = std::make_unique<Model>(model);
    steady->operation.ripple = 0.0;
    std::fill_n(steady->operation.proportional, AXES, 0.0);
    auto start = std::unique_ptr<Start>(new Start{*steady, force, state, {}, {}, {}, {}});
    double drags[AXES];
    mean_drag(*start, drags);
    balance_at_angle(*start);
    if constexpr (MOVING)
        find_unbalanced(*start, found);
    else
        choose_sides(*start);
    trim(model, drags, state);
    if (is_closed(train, state) && creeps(train, frame_cycle_rate(train, state))) {
        for (int n = 0; n < BALANCING_PASSES; ++n) {
            balance_friction(*start, drags);
            trim(model, drags, state);
        }
    }
    return found;
}

}  // namespace gearbox
