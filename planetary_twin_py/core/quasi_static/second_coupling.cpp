#include "quasi_static/second_coupling.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "model/set_step_constants.hpp"
#include "quasi_static/motion.hpp"

namespace gearbox {

namespace {

constexpr int POINTS = 256;    // in a mesh cycle; a jump of the torque counts as a slope between
                               // adjacent ones
constexpr double RIGID = 1e9;  // factor on the stiffness for a rigid coupling

}  // namespace

double steepest_torque(const Model& model, double tolerance, std::int64_t closing_side,
                       const State& origin, const double* speed) {
    auto rigid = std::make_unique<Model>(model);
    rigid->train.coupling.stiffness[SECOND_MOTOR] *= RIGID;
    State begin = origin;
    for (int a = 0; a < AXES; ++a)
        rigid->operation.target_speed[a] = begin.set_speed[a] = begin.speed[a] = speed[a];
    double rate = std::abs(frame_cycle_rate(rigid->train, begin));
    if (rate == 0.0) return 0.0;
    auto run = std::make_unique<Equilibrium>(first_guess(closing_side));
    double shown[QUANTITIES][MESHES], before = 0.0, steepest = 0.0;
    for (int n = 0; n <= POINTS; ++n) {
        advance_shafts(*rigid, begin, n / (POINTS * rate), run->state);
        solve_equilibrium(*rigid, tolerance, *run, shown);
        double torque = run->torque[SECOND_MOTOR];
        if (n > 0) steepest = std::max(steepest, std::abs(torque - before));
        before = torque;
    }
    return steepest * POINTS;
}

}  // namespace gearbox
