#pragma once

// One explicit step of order 3 with an error of order 2 (Bogacki and Shampine 1989).

#include "integrators/rosenbrock.hpp"
#include "model/body_speed.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace bogacki_shampine {

constexpr int STAGES = 4;  // the last is the new state
constexpr double A[STAGES][STAGES - 1] = {
    {0.0, 0.0, 0.0}, {1.0 / 2, 0.0, 0.0}, {0.0, 3.0 / 4, 0.0}, {2.0 / 9, 1.0 / 3, 4.0 / 9}};
constexpr double ABSCISSA[STAGES] = {0.0, 1.0 / 2, 3.0 / 4, 1.0};
constexpr double ERROR[STAGES] = {2.0 / 9 - 7.0 / 24, 1.0 / 3 - 1.0 / 4, 4.0 / 9 - 1.0 / 3,
                                  -1.0 / 8};

// The state of stage i, from the slopes of those before it.
inline void advance(const Train& train, const State& state, double h, int i, State& out,
                    const Workspace& work) {
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        out.x[j] = state.x[j];
        out.v[j] = state.v[j];
        for (int s = 0; s < i; ++s) {
            out.x[j] += h * A[i][s] * work.ux[s][j];
            out.v[j] += h * A[i][s] * work.uv[s][j];
        }
    }
    for (std::int64_t a = 0; a < train.axes; ++a) {
        out.trim[a] = state.trim[a];
        for (int s = 0; s < i; ++s) out.trim[a] += h * A[i][s] * work.trim_rate[s][a];
    }
}

// Slopes of stage i, and their share of the errors and of the energy.
inline void slopes(const Train& train, const State& state, const StepConstants& constants, double h,
                   int i, const Evaluation& at, const State& out, Workspace& work) {
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        work.ux[i][j] = out.v[j];
        work.uv[i][j] = at.force[j] / train.body.mass[j];
        work.error_x[j] += h * ERROR[i] * work.ux[i][j];
        work.error_v[j] += h * ERROR[i] * work.uv[i][j];
    }
    for (std::int64_t a = 0; a < train.axes; ++a) {
        double set_speed = state.set_speed[a] + constants.slew[a] * ABSCISSA[i] * h;
        double speed = body_speed(train, state, out.v, train.coupling.ends[2 * a][0]);
        work.trim_rate[i][a] = set_speed - speed;
    }
    if (i == STAGES - 1) return;
    const double weight = h * A[STAGES - 1][i];
    for (int e = 0; e < LEDGER; ++e) work.energy[e] += weight * at.power[e];
    for (std::int64_t c = 0; c < train.machines; ++c)
        work.machine_displacement[c] += weight * out.v[train.coupling.ends[c][0]];
}

}  // namespace bogacki_shampine

// Advance x, v and trim of `state` by h seconds into `out`; errors and energy into `work`.
inline void explicit_step(const Model& model, const State& state, const StepConstants& constants,
                          double h, const Evaluation& first, State& out, Workspace& work) {
    namespace method = bogacki_shampine;
    for (double& energy : work.energy) energy = 0.0;
    for (double& displacement : work.machine_displacement) displacement = 0.0;
    for (int j = 0; j < BODIES; ++j) work.error_x[j] = work.error_v[j] = 0.0;
    for (int i = 0; i < method::STAGES; ++i) {
        method::advance(model.train, state, h, i, out, work);
        if (i > 0)
            forces(model, state, constants, out.x, out.v, method::ABSCISSA[i] * h, out.trim,
                   work.evaluation);
        const Evaluation& at = i == 0 ? first : work.evaluation;
        method::slopes(model.train, state, constants, h, i, at, out, work);
    }
    add_machine_work(model.train, state, h, out, work);
}

}  // namespace gearbox
