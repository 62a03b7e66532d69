#include "right_hand_side.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "capacities.hpp"
#include "mesh/backlash.hpp"
#include "mesh/cycle.hpp"
#include "mesh/deflection.hpp"
#include "mesh/faults.hpp"
#include "model/body_speed.hpp"
#include "model/equations.hpp"
#include "model/observe.hpp"
#include "model/set_step_constants.hpp"

namespace gearbox {

namespace {

// Fill the state of the bodies and the motors at time t.
void place_bodies(Problem& problem, double t, const double* y) {
    const Train& train = problem.model.train;
    const Operation& operation = problem.model.operation;
    const State& start = problem.start;
    State& state = problem.state;
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        state.x[j] = start.x[j] + y[j];
        state.v[j] = start.v[j] + y[train.bodies + j];
    }
    for (std::int64_t a = 0; a < train.axes; ++a) {
        state.trim[a] = start.trim[a] + y[2 * train.bodies + a];
        state.speed[a] = start.speed[a];
        double turn = start.fraction[a] + start.speed[a] * t / (2.0 * std::numbers::pi);
        double whole = std::floor(turn);
        state.turns[a] = start.turns[a] + whole;
        state.fraction[a] = turn - whole;
        double gap = operation.target_speed[a] - start.set_speed[a],
               slewed = operation.slew_rate * t;
        state.set_speed[a] = start.set_speed[a] + std::max(-slewed, std::min(gap, slewed));
    }
}

// Side and segment (from 1 on) of the tables in `step`.
struct StoredTables {
    double side[MESHES];
    std::int64_t segment[MESHES];
};

// Open all meshes, without changing the tables.
StoredTables open_meshes(const Train& train, State& state, StepConstants& step) {
    StoredTables stored;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        stored.side[i] = step.side[i];
        stored.segment[i] = step.segment[i];
        state.side[i] = OPEN;
        step.side[i] = 0.0;
        step.segment[i] = state.segment[i] + 1;
    }
    return stored;
}

// As `copy_segment`, the most expensive part here, if other tables are stored.
void copy_tables(const Train& train, const State& state, StepConstants& step, std::int64_t i,
                 const StoredTables& stored) {
    double side = static_cast<double>(state.side[i]);
    std::int64_t segment = state.segment[i] + 1;
    if (stored.side[i] == side && stored.segment[i] == segment) {
        step.side[i] = side;
        step.segment[i] = segment;
    } else {
        copy_segment(train, state, step, i);
    }
}

// Find the flanks in contact and the segments of their tooth pairs.
void find_contacts(Problem& problem, const StoredTables& stored) {
    const Train& train = problem.model.train;
    State& state = problem.state;
    StepConstants& step = problem.step;
    const double *x = state.x, *v = state.v;
    double cycle_rate = step.cycle_rate + cycle_shift(train, v);
    double cycles = frame_cycle(train, state, 1) + cycle_shift(train, x);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (contact_event(problem.model, state, step, i, x, v, {0.0, cycle_rate, 0.0}) >= 0.0) {
            copy_tables(train, state, step, i, stored);
            continue;
        }
        double d = deflection(train, step, i, x, v, 0.0, cycle_rate).d;
        std::int64_t side = d > 0.0 ? DRIVE_SIDE : COAST_SIDE;
        // As `mesh_cycle`, but the cycles of the frame, which are expensive, are counted once.
        double cycle = static_cast<double>(side) * (cycles - train.mesh.phase[i]);
        if (side == COAST_SIDE) cycle += train.geometry.coast_lead[train.mesh.kind[i]];
        cycle -= std::floor(cycle - train.teeth.edge[train.mesh.kind[i]][0]);
        state.side[i] = side;
        state.segment[i] =
            find_segment(train, train.mesh.kind[i], cycle, static_cast<double>(side) * cycle_rate);
        copy_tables(train, state, step, i, stored);
        step.start[i] = cycle;
        if (train.faults.count > 0) find_faults(train, state, i, side, cycle, step);
    }
}

}  // namespace

void place_problem(Problem& problem, double t, const double* y) {
    place_bodies(problem, t, y);
    StoredTables stored = open_meshes(problem.model.train, problem.state, problem.step);
    set_step_constants(problem.model, problem.state, problem.step);
    find_contacts(problem, stored);
}

void derivative(Problem& problem, double t, const double* y, double* dy) {
    place_problem(problem, t, y);
    const Train& train = problem.model.train;
    const State& state = problem.state;
    std::int64_t n = train.bodies;
    forces(problem.model, state, problem.step, state.x, state.v, 0.0, state.trim,
           problem.evaluation);
    for (std::int64_t j = 0; j < n; ++j) {
        dy[j] = state.v[j];
        dy[n + j] = problem.evaluation.force[j] / train.body.mass[j];
    }
    for (std::int64_t a = 0; a < train.axes; ++a)
        dy[2 * n + a] =
            state.set_speed[a] - body_speed(train, state, state.v, train.coupling.ends[2 * a][0]);
}

double show_problem(Problem& problem, double t, const double* y, double* dte) {
    place_problem(problem, t, y);
    const State& state = problem.state;
    std::int64_t meshes = problem.model.train.meshes;
    double shown[QUANTITIES][MESHES], lost = 0.0;
    observe(problem.model, state, problem.step, state.x, state.v, 0.0, problem.evaluation, shown);
    std::copy(shown[DTE], shown[DTE] + meshes, dte);
    for (std::int64_t i = 0; i < meshes; ++i) lost += shown[POWER_LOSS][i];
    return lost;
}

}  // namespace gearbox
