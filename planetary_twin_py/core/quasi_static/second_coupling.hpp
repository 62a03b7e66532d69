#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "model/set_step_constants.hpp"
#include "quasi_static/equilibrium.hpp"
#include "quasi_static/motion.hpp"

namespace gearbox {

constexpr int POINTS_IN_CYCLE = 256;    // a jump of the torque counts as a slope between two
constexpr double RIGID_COUPLING = 1e9;  // factor on the stiffness

// Largest change of the second motor's torque per mesh cycle [N m] at constant `speed` (AXES,),
// with a rigid coupling.
//
// closing_side: side of the teeth that the mean torque loads. origin: position of the motors.
inline double steepest_torque(const Model& model, double tolerance, std::int64_t closing_side,
                              const State& origin, const double* speed) {
    auto rigid = std::make_unique<Model>(model);
    rigid->train.coupling.stiffness[SECOND_MOTOR] *= RIGID_COUPLING;
    State begin = origin;
    for (int a = 0; a < AXES; ++a)
        rigid->operation.target_speed[a] = begin.set_speed[a] = begin.speed[a] = speed[a];
    double rate = std::abs(frame_cycle_rate(rigid->train, begin));
    if (rate == 0.0) return 0.0;
    auto run = std::make_unique<Equilibrium>(first_guess(closing_side));
    double shown[QUANTITIES][MESHES], before = 0.0, steepest = 0.0;
    for (int n = 0; n <= POINTS_IN_CYCLE; ++n) {
        advance_shafts(*rigid, begin, n / (POINTS_IN_CYCLE * rate), run->state);
        solve_equilibrium(*rigid, tolerance, *run, shown);
        double torque = run->torque[SECOND_MOTOR];
        if (n > 0) steepest = std::max(steepest, std::abs(torque - before));
        before = torque;
    }
    return steepest * POINTS_IN_CYCLE;
}

}  // namespace gearbox
