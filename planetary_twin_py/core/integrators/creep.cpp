#include "integrators/creep.hpp"

#include "integrators/step_control.hpp"
#include "train/equations.hpp"
#include "tribology/bristles.hpp"

namespace gearbox {

namespace {

// Speed of a gear against the carrier, of that without vibration, below which it may come to stick.
constexpr double STICKING = 0.5;

}  // namespace

void hold_or_slide(const Model& model, March& march) {
    Control& control = march.control;
    State& begin = march.begin;
    bool creeping = creeps(model.train, march.constants.cycle_rate);
    if (creeping == control.creeping) return;
    control.creeping = creeping;
    control.changed = true;
    if (creeping) {
        forces(model, begin, march.constants, begin.x, begin.v, 0.0, begin.trim, march.first);
        steady_bristles(march.first.pairs, begin.bristle);
    }
    march.first.pairs.held = march.last.pairs.held = creeping;
    march.work.evaluation.pairs.held = creeping;
}

void avoid_reversals(const Model& model, March& march) {
    const Train& train = model.train;
    Control& control = march.control;
    if (control.creeping || !control.slow) return;
    const double *rigid = march.constants.rigid, *v = march.begin.v;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        std::int64_t carrier = train.body[i][2];
        double turning = v[carrier] * train.inverse_radius[carrier];
        for (int gear = 0; gear < 2; ++gear) {
            std::int64_t body = train.body[i][gear];
            double steady = rigid[body] - rigid[carrier];
            double speed = steady + v[body] * train.inverse_radius[body] - turning;
            if (speed * steady < STICKING * steady * steady) {
                control.detour = DETOUR;
                ++control.reversals;
                return;
            }
        }
    }
}

}  // namespace gearbox
