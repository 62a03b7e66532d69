#include "quasi_static/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mesh/both_flanks.hpp"
#include "mesh/cycle.hpp"
#include "mesh/deflection.hpp"
#include "mesh/form_errors.hpp"
#include "model/observe.hpp"
#include "quasi_static/friction.hpp"
#include "quasi_static/machines.hpp"
#include "quasi_static/statics.hpp"

namespace gearbox {

namespace {

constexpr int MOST_PASSES = 60;
constexpr int UNRELAXED_PASSES = 5;  // then oscillating friction is under-relaxed
constexpr int FREE_PASSES = 20;  // then tooth pairs are fixed: at a jump of the stiffness they may
                                 // not converge
constexpr double PLACE = 0.01;   // allowed change of position in mesh cycles per unit of
                                 // the tolerance
constexpr double LIGHTEST_FORCE = 1.0;  // [N] smaller forces do not tighten the tolerance further

// Whether stiffness and clearance are those of the sides and tooth pairs that carry now.
bool keeps_sides(const Train& train, const Equilibrium& run, const double (*shown)[MESHES],
                 double slack) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (std::abs(run.force[i]) > slack && run.state.side[i] != run.closing_side[i])
            return false;
        if (std::abs(shown[MESH_FORCE][i] - run.force[i]) > slack) return false;
    }
    return true;
}

// Whether friction and drag of these forces agree with those they were computed from.
bool friction_converged(const Model& model, Equilibrium& run, double slack) {
    Evaluation& evaluation = run.evaluation;
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        evaluation.now.normal_force[i] = std::abs(run.force[i]);
    update_friction(model, run);
    bool still = true;
    for (std::int64_t j = 0; j < model.train.bodies; ++j) {
        double change = std::abs(evaluation.friction_force[j] - run.before[j]);
        still = still && change <= slack * model.train.body.copies[j];
    }
    return still;
}

// A force that jumps where flanks come into contact cannot be below its jump at rest.
void check_jump(const Model& model, const Equilibrium& run) {
    const Operation& operation = model.operation;
    if (operation.backlash.half == operation.backlash.offset) return;
    for (std::int64_t i = 0; i < model.train.meshes; ++i) {
        double side = static_cast<double>(run.state.side[i]);
        double d = mesh_motion(model.train, i, run.state.x) - run.error[i];
        double radial = radial_error(model.train, i, run.step.line_angle, 0.0, 0.0).length;
        if (side != 0.0 && side * d - radial < operation.backlash.half)
            throw std::invalid_argument(
                "mesh.backlash = 'regulatory_factor': without dynamics every mesh must carry "
                "more than its stiffness times the backlash");
    }
}

}  // namespace

void solve_equilibrium(const Model& model, double tolerance, Equilibrium& run,
                       double (*shown)[MESHES]) {
    const Train& train = model.train;
    State& state = run.state;
    bool kept = false;
    for (int n = 0; n < MOST_PASSES; ++n) {
        bool free = n < FREE_PASSES;
        double shift = cycle_shift(train, state.x);
        if (free || !kept) place_springs(model, run);
        put_external(model, run);
        double mean = solve_load_sharing(model, run);
        place_planets(model, run);
        observe(model, state, run.step, state.x, state.v, 0.0, run.evaluation, shown);
        double slack = tolerance * std::max(mean, LIGHTEST_FORCE);
        if (!free) slack = std::max(slack, NEGLIGIBLE_FORCE);
        double moved = std::abs(cycle_shift(train, state.x) - shift);
        kept = keeps_sides(train, run, shown, slack);
        bool rests = kept && (moved <= PLACE * tolerance || !free);
        if (friction_converged(model, run, slack) && rests) {
            check_jump(model, run);
            put_external(model, run);
            add_machine_powers(model, run);
            if (both_flanks_touch(model, state, run.step)) ++run.both_flanks;
            return;
        }
        if (n >= UNRELAXED_PASSES) relax_friction(train, run);
    }
    throw std::invalid_argument(
        "dynamics = 'quasi_static': no static equilibrium is found, some planet has none between "
        "its flanks; soften the entry of teeth (mesh.ramp) or load the train more");
}

}  // namespace gearbox
