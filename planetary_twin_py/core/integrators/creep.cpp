#include "integrators/creep.hpp"

#include <cmath>

#include "integrators/methods.hpp"
#include "lubrication/bristles.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace {

// Reduction of the speed of a gear relative to the carrier by vibration, as a share of its rigid
// speed, above which the gear may stick.
constexpr double STICKING = 0.5;
// The same for creeping gears. Friction that decreases with speed excites their vibration, which
// grows from the smallest error until the gears stick.
constexpr double SWINGING = 0.2;
constexpr double ROUNDING = 1e-9;  // of the speeds of two motors, in their difference

// Whether no body vibrates so fast that it could reduce the speed of a gear relative to the carrier
// by half: a bound that spares `vibration_slows`.
bool vibration_is_slow(const Train& train, const State& state, const StepConstants& step) {
    static_assert(STICKING == 0.5);
    return with_lanes(train, [&]<int L>(std::integral_constant<int, L>) {
        using OfMeshes = Row<MESH_LANES<L>>;
        const double vibration =
            largest(absolute(Row<L>(state.v) * Row<L>(train.body.inverse_radius)));
        OfMeshes slowest =
            smaller(absolute(OfMeshes(step.spin[0])), absolute(OfMeshes(step.spin[1])));
        return none(first_of_row<MESH_LANES<L>>(train.meshes) & !(slowest > 4.0 * vibration));
    });
}

// Whether vibration reduces the speed of a gear relative to the carrier by more than this part of
// its rigid speed.
bool vibration_slows(const Train& train, const double* v, const double* rigid, double part) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        std::int64_t carrier = train.mesh.body[i][2];
        double turning = v[carrier] * train.body.inverse_radius[carrier];
        for (int gear = 0; gear < 2; ++gear) {
            std::int64_t body = train.mesh.body[i][gear];
            double steady = rigid[body] - rigid[carrier];
            double change = v[body] * train.body.inverse_radius[body] - turning;
            if (-change * steady > part * steady * steady) return true;
        }
    }
    return false;
}

// Whether friction may excite vibration of creeping gears. The vibration is compared with the
// target speed: near a reversal, any vibration exceeds the present speed.
bool creep_swings(const Model& model, const Integrator& integrator) {
    const Train& train = model.train;
    double rigid[BODIES], rate = 0.0, size = 0.0;
    for (std::int64_t a = 0; a < train.axes; ++a) {
        double share = train.cycle.per_turn[a] * model.operation.target_speed[a];
        rate += share;
        size += std::fabs(share);
    }
    if (!(std::fabs(rate) > ROUNDING * size)) return false;  // the target is standstill
    for (int j = 0; j < BODIES; ++j) {
        rigid[j] = 0.0;
        for (std::int64_t a = 0; a < train.axes; ++a)
            rigid[j] += train.body.ratio[a][j] * model.operation.target_speed[a];
    }
    return vibration_slows(train, integrator.begin.v, rigid, SWINGING);
}

}  // namespace

void select_friction_model(const Model& model, Integrator& integrator) {
    Control& control = integrator.control;
    State& begin = integrator.begin;
    bool creeping = creeps(model.train, integrator.constants.cycle_rate);
    if (creeping == control.creeping) return;
    control.creeping = creeping;
    control.changed = true;
    if (creeping) {
        forces(model, begin, integrator.constants, begin.x, begin.v, 0.0, begin.trim,
               integrator.first);
        steady_bristles(integrator.first.pairs, begin.bristle);
    } else {
        begin.energy[STIFFNESS_WORK] -= begin.presliding;
        begin.presliding = 0.0;
    }
    integrator.first.pairs.has_bristles = integrator.last.pairs.has_bristles = creeping;
    integrator.work.evaluation.pairs.has_bristles = creeping;
}

void avoid_reversals(const Model& model, Integrator& integrator) {
    Control& control = integrator.control;
    const double* rigid = integrator.constants.rigid;
    if (control.creeping) {
        control.reversals += creep_swings(model, integrator);
    } else if (control.friction_limits_speed &&
               !vibration_is_slow(model.train, integrator.begin, integrator.constants) &&
               vibration_slows(model.train, integrator.begin.v, rigid, STICKING)) {
        control.fallback_steps = FALLBACK_STEPS;
        ++control.reversals;
    }
}

}  // namespace gearbox
