#include "quasi_static/follow.hpp"

#include <algorithm>

#include "lubrication/tooth_friction.hpp"
#include "mesh/mesh_forces.hpp"
#include "model/passages.hpp"
#include "quasi_static/motion.hpp"

namespace gearbox {

namespace {

constexpr double SHORTEST = 1e-12;   // [s]: panel
constexpr double BESIDE_END = 1e-6;  // of a panel

// Count the equilibrium `after` seconds after `origin`, for which `weight` seconds stand.
void count_at(const EquilibriumSolver& solver, const State& origin, double after, double weight,
              Passages& passages, MeshSums& sums) {
    const Model& model = solver.model;
    const Train& train = model.train;
    Equilibrium& run = solver.run;
    MeshesNow& now = run.evaluation.now;
    advance_shafts(model, origin, after, run.state);
    solve_equilibrium(model, solver.tolerance, run, solver.shown);
    if (train.friction)
        find_heat_of_pairs(train, model.oil, run.evaluation.pairs, run.evaluation.friction);
    StepPeaks peaks;
    with_mesh_lanes(train, [&](auto lanes) {
        clear_contacts<lanes>(peaks);
        distribute_forces<lanes>(train, run.step, now);
        find_stresses<lanes>(train, run.step, now, peaks.stress);
        if (train.friction) raise_contacts<lanes>(run.evaluation.friction, peaks);
    });
    end_passages(train, run.state, run.step, passages, sums);
    keep_peaks(model, run.state, peaks, passages, sums);
    follow_shafts(train, run.torque, passages, sums);
    if (!has_bearings(train)) return;
    rate_bearings(model, run.step, now, run.state.x, run.state.v, passages.bearing_rate);
    add_bearings(train, passages.bearing_rate, weight, sums);
}

}  // namespace

void follow_passages(const EquilibriumSolver& solver, State& state, std::span<const double> edges,
                     const Instant& until, Passages& passages, MeshSums& sums) {
    sums.damaging = true;
    for (double left = delay(state, until); left > SHORTEST; left = delay(state, until)) {
        const double length =
            std::min(std::max(panel_length(solver.model, state, edges), SHORTEST), left);
        const double half = 0.5 * length;
        count_at(solver, state, BESIDE_END * length, 0.0, passages, sums);
        for (int n = 0; n < PANEL_NODES; ++n)
            count_at(solver, state, half * (1.0 + GAUSS_NODES[n]), half * GAUSS_WEIGHTS[n],
                     passages, sums);
        count_at(solver, state, (1.0 - BESIDE_END) * length, 0.0, passages, sums);
        advance_shafts(solver.model, state, length, state);
    }
}

}  // namespace gearbox
