// Static equilibrium of a train with moving axes: unilateral flanks, bearings, friction.
//
// All forces are those of the dynamic model, on bodies at rest in the frame that turns with the
// motors. Springs of flanks and bearings are piecewise smooth and their energy is convex, so
// Newton's method finds the equilibrium (see statics/statics.py); friction, some per cent of the
// forces, is updated in an outer iteration.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "mesh/cycle.hpp"
#include "mesh/join_flanks.hpp"
#include "model/axes_forces.hpp"
#include "model/equations.hpp"
#include "model/observe.hpp"
#include "model/resting_springs.hpp"
#include "model/set_step_constants.hpp"
#include "quasi_static/equilibrium.hpp"
#include "quasi_static/friction.hpp"
#include "quasi_static/machines.hpp"

namespace gearbox {

namespace {

constexpr int MOST_PASSES = 100;
constexpr int UNRELAXED_PASSES = 30;    // then oscillating friction is under-relaxed
constexpr double OVERSHOOT = 0.5;       // share of the initial force that shortens a step
constexpr double LIGHTEST_FORCE = 1.0;  // [N] smaller forces do not tighten the tolerance further

// Share of their stiffness that open flanks and bearings within their clearance have in a step, so
// that no step is much longer than backlash and clearance, at the cost of a few more steps.
constexpr double IDLE_MESH = 1e-3, IDLE_BEARING = 1e-2;

using SquareMatrix = double[BODIES][BODIES];

// Close the flanks on one side, with all bodies at their positions in the frame.
void close_side(const Model& model, Equilibrium& run, std::int64_t side) {
    State& state = run.state;
    std::fill(std::begin(state.x), std::end(state.x), 0.0);
    std::fill_n(run.evaluation.friction_force, BODIES, 0.0);
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        state.side[i] = only_side(model.train, i) == side ? side : OPEN;
}

bool any_touches(const Train& train, const State& state) {
    return std::any_of(state.side, state.side + train.meshes,
                       [](std::int64_t side) { return side != OPEN; });
}

// Update friction and drag from the forces in `run.evaluation`; their largest change [N].
double change_friction(const Model& model, Equilibrium& run, bool midway) {
    double (&now)[MESHES] = run.evaluation.now.normal_force;
    double normal_force[MESHES];  // negative in the initial guess, where flanks may still be open
    std::copy_n(now, MESHES, normal_force);
    for (double& force : now) force = std::max(force, 0.0);
    update_friction(model, run);
    std::copy_n(normal_force, MESHES, now);
    double change = 0.0;
    for (std::int64_t j = 0; j < model.train.bodies; ++j)
        change = std::max(change, std::fabs(run.evaluation.friction_force[j] - run.before[j]));
    if (midway) relax_friction(model.train, run);
    return change;
}

// Forces on all bodies but the motors, which are fixed to their frame.
void find_forces(const Model& model, Equilibrium& run, double* force) {
    const Train& train = model.train;
    const State& state = run.state;
    const Evaluation& evaluation = run.evaluation;
    double ignored[LEDGER] = {};
    std::copy_n(evaluation.friction_force, BODIES, run.external);
    apply_axes(train, state, run.step.rigid, 0.0, state.x, state.v, run.external, ignored);
    balance_torques(model, run);
    std::copy_n(run.external, BODIES, force);
    add_mesh_forces(train, state, evaluation.now, force);
    if (tilts(train)) add_slope_moments(train, evaluation.now, force);
    MachineForces forces;
    apply_couplings(train, state.x, state.v, forces, ignored);
    add_at_shafts(train, forces, force);
    for (std::int64_t a = 0; a < train.axes; ++a) force[train.coupling.ends[2 * a][0]] = 0.0;
    force[train.bodies] = 0.0;  // the ground
}

// Rows of bearing b with its stiffness at x: along the eccentricity, and across it that from the
// rotation of its force.
BearingRows tangent_rows(const Train& train, std::int64_t b, const double* x) {
    BearingRows rows = rows_of_bearing(train, b);
    const MovingAxes& axes = train.moving;
    if (is_linear(axes, b)) return rows;
    InPlane r = across_bearing(train, b, x);
    r.along -= axes.centre[b][0];
    r.across -= axes.centre[b][1];
    const double size = std::sqrt(r.along * r.along + r.across * r.across);
    const BearingResponse at = bearing_law(axes, b, size);
    BearingRow first = rows.row[0], second = rows.row[1];
    const double cosine = size > 0.0 ? r.along / size : 1.0;
    const double sine = size > 0.0 ? r.across / size : 0.0;
    for (int e = 0; e < first.size; ++e) {
        rows.row[0].factor[e] = cosine * first.factor[e] + sine * second.factor[e];
        rows.row[1].factor[e] = cosine * second.factor[e] - sine * first.factor[e];
    }
    const double least = IDLE_BEARING * axes.stiffness[b];
    rows.row[0].stiffness = std::max(at.stiffness, least);
    rows.row[1].stiffness = std::max(size > 0.0 ? at.force / size : 0.0, least);
    return rows;
}

// Stiffness of all springs at x.
void assemble(const Train& train, const Equilibrium& run, SquareMatrix& stiffness) {
    std::memset(stiffness, 0, sizeof stiffness);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double k = train.mesh.copies[i] * run.evaluation.now.stiffness[i];
        if (run.state.side[i] == OPEN) {
            if (run.state.side[other_flank(train, i)] != OPEN) continue;
            k = IDLE_MESH * train.mesh.copies[i] * train.teeth.stiffness[train.mesh.kind[i]];
        }
        add_mesh_stiffness(train, i, k, stiffness);
    }
    add_coupling_stiffness(train, stiffness);
    for (std::int64_t b = 0; b < train.moving.bearings; ++b)
        for (const BearingRow& row : tangent_rows(train, b, run.state.x))
            add_outer(stiffness, row.place, row.factor, row.size, row.stiffness);
    regularise(train, stiffness);
}

// Mean force of the meshes of one kind [N].
double mean_force(const Train& train, const double (*shown)[MESHES]) {
    double total = 0.0, copies = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        total += train.mesh.copies[i] * std::fabs(shown[MESH_FORCE][i]);
        copies += train.mesh.copies[i];
    }
    return FLANKS * total / copies;
}

// Largest unbalanced force [N], of one of the bodies with the same motion.
double largest(const Train& train, const double* force) {
    double found = 0.0;
    for (std::int64_t j = 0; j < train.bodies; ++j)
        found = std::max(found, std::fabs(force[j]) / train.body.copies[j]);
    return found;
}

// A step of Newton's method, and the position of the bodies along it.
//
// Along a line the forces of a convex energy decrease. Where they have reversed and exceed a share
// of their initial value, the secant shortens the step. Where that leaves them as large as before,
// with flanks open that closed beyond, the step is extended to halfway.
class Line {
public:
    // Step to the position in which the springs of `run` balance the forces.
    void start(const Train& train, const Equilibrium& run, const double* force) {
        alignas(64) SquareMatrix stiffness;
        assemble(train, run, stiffness);
        std::copy_n(run.state.x, BODIES, start_);
        std::copy_n(force, BODIES, direction_);
        const double turning = run.step.rigid[train.moving.frame];
        convex_ = displace_springs(train, turning, stiffness, direction_);
        initial_work_ = short_work_ = along(train, force);
        fraction_ = 1.0;
        short_ = 0.0;
        long_ = std::numeric_limits<double>::infinity();
    }

    void step(const Train& train, double* x) const {
        for (std::int64_t j = 0; j < train.bodies; ++j)
            x[j] = start_[j] + fraction_ * direction_[j];
    }

    // Line search: given the forces at the end of the step, choose its next length. Returns
    // false if this length is accepted.
    bool corrects(const Train& train, const double* force) {
        if (!convex_) return false;
        const double work = along(train, force);
        if (work < -OVERSHOOT * initial_work_) {
            long_ = fraction_;
            fraction_ = short_ + (long_ - short_) * short_work_ / (short_work_ - work);
            return true;
        }
        if (work > OVERSHOOT * initial_work_ && std::isfinite(long_)) {
            short_ = fraction_;
            short_work_ = work;
            fraction_ = 0.5 * (short_ + long_);
            return true;
        }
        return false;
    }

private:
    double along(const Train& train, const double* force) const {
        double sum = 0.0;
        for (std::int64_t j = 0; j < train.bodies; ++j) sum += force[j] * direction_[j];
        return sum;
    }

    alignas(64) double start_[BODIES];
    alignas(64) double direction_[BODIES];
    bool convex_;                // whether springs are stiffer than centrifugal forces
    double initial_work_;        // force along the step at its start, times its length [J]
    double fraction_;            // of the step
    double short_, short_work_;  // largest fraction that is too short, and its work [J]
    double long_;                // smallest fraction that is too long
};

// Newton's method from the positions of the bodies; whether it ends in equilibrium.
bool converges(const Model& model, double tolerance, Equilibrium& run, double (*shown)[MESHES]) {
    const Train& train = model.train;
    State& state = run.state;
    alignas(64) double force[BODIES];
    Line line;
    find_tooth_pairs(model, state, run.step);
    for (int n = 0; n < MOST_PASSES; ++n) {
        const bool changes = n > 0 && touch_flanks(model, state, run.step);
        if (n > 0) find_tooth_pairs(model, state, run.step);
        observe(model, state, run.step, state.x, state.v, 0.0, run.evaluation, shown);
        double slack = tolerance * std::max(mean_force(train, shown), LIGHTEST_FORCE);
        const bool unrelaxed = n < UNRELAXED_PASSES;
        if (!unrelaxed) slack = std::max(slack, NEGLIGIBLE_FORCE);
        const double change = change_friction(model, run, !unrelaxed);
        find_forces(model, run, force);
        if (n > 0 && !changes && largest(train, force) <= slack && (unrelaxed || change <= slack)) {
            if (!unrelaxed) {  // friction without relaxation, with its losses
                change_friction(model, run, false);
                find_forces(model, run, force);
            }
            add_machine_powers(model, run);
            return true;
        }
        if (n == 0 || !line.corrects(train, force)) line.start(train, run, force);
        line.step(train, state.x);
    }
    return false;
}

}  // namespace

void solve_equilibrium(const Model& model, double tolerance, Equilibrium& run,
                       double (*shown)[MESHES]) {
    if (!any_touches(model.train, run.state)) close_side(model, run, run.closing_side[0]);
    if (converges(model, tolerance, run, shown)) return;
    for (std::int64_t side : {run.closing_side[0], -run.closing_side[0]}) {
        close_side(model, run, side);
        if (converges(model, tolerance, run, shown)) return;
    }
    throw std::invalid_argument(
        "dynamics: no static equilibrium is found, bearings or meshes cannot balance the load; "
        "give planets bearings against displacement and tilting (supports.planet), soften the "
        "entry of teeth (mesh.ramp), load the train more, or choose dynamics = 'planar'");
}

}  // namespace gearbox
