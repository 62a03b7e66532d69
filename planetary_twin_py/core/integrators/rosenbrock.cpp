#include "integrators/rosenbrock.hpp"

#include <cstring>

#include "integrators/bristle_stage.hpp"
#include "integrators/rosenbrock_coefficients.hpp"
#include "lubrication/tooth_friction.hpp"
#include "mesh/cycle.hpp"
#include "mesh/mesh_forces.hpp"
#include "mesh/stiffness.hpp"
#include "model/bearings.hpp"
#include "model/body_speed.hpp"
#include "model/drag.hpp"
#include "model/equations.hpp"
#include "model/resting_springs.hpp"
#include "vector/cholesky.hpp"

namespace gearbox {

namespace {

using namespace ros34pw2;

// Change of given torques with time.
void add_machine_time_derivatives(const Model& model, Workspace& work) {
    const Train& train = model.train;
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t body = train.coupling.ends[c][0];
        work.time_derivative[body] +=
            model.operation.torque_rate[c] * train.body.inverse_radius[body];
    }
}

// K, and M/(gamma h) + C + gamma h K, of the contacts at the middle of the step.
void assemble_meshes(const Model& model, const State& state, const StepConstants& constants,
                     double h, Workspace& work) {
    const Train& train = model.train;
    const double step = GAMMA * h, cycle_rate = constants.cycle_rate + cycle_shift(train, state.v);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (state.side[i] == OPEN) continue;
        std::int64_t kind = train.mesh.kind[i];
        double side = static_cast<double>(state.side[i]), copies = train.mesh.copies[i];
        double time_derivative =
            copies * force_time_derivative(model, state, constants, i, cycle_rate);
        for (int j = 0; j < entries_of(train); ++j)
            work.time_derivative[train.mesh.body[i][j]] -=
                side * time_derivative * train.mesh.sign[i][j];
        double cycle = constants.start[i] + side * cycle_rate * 0.5 * h;
        double k = copies * mesh_stiffness(train, i, state.segment[i], cycle);
        add_mesh_stiffness(train, i, k, work.stiffness);
        add_mesh_stiffness(train, i, k * (constants.tau[kind] + step), work.system);
    }
}

// Decouple the ends of shafts with given motion: no forces of the train act on them.
void free_given(const Model& model, double h, Workspace& work) {
    const Train& train = model.train;
    for (std::int64_t c = 0; c < train.machines; ++c) {
        if (model.operation.port[c] != BY_MOTION) continue;
        std::int64_t body = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        work.stiffness[body][body] = work.stiffness[body][member] = 0.0;
        work.system[body][member] = work.system[member][body] = 0.0;
        work.system[body][body] = train.body.mass[body] / (GAMMA * h);
    }
}

// The same of the bearings beyond their clearances; the rotation of the frame is neglected.
void assemble_bearings(const Train& train, const State& state, double step, Workspace& work) {
    for (std::int64_t b = 0; b < train.moving.bearings; ++b) {
        const bool loaded = beyond_clearance(train, b, state.x);
        for (const BearingRow& row : rows_of_bearing(train, b)) {
            if (row.radial && !loaded) continue;
            add_outer(work.stiffness, row.place, row.factor, row.size, row.stiffness);
            add_outer(work.system, row.place, row.factor, row.size,
                      row.damping + step * row.stiffness);
        }
    }
}

void assemble(const Model& model, const State& state, const StepConstants& constants, double h,
              const Evaluation& first, Workspace& work) {
    const Train& train = model.train;
    const double step = GAMMA * h;
    std::memset(work.stiffness, 0, sizeof work.stiffness);
    std::memset(work.system, 0, sizeof work.system);
    std::memset(work.time_derivative, 0, sizeof work.time_derivative);
    assemble_meshes(model, state, constants, h, work);
    add_machine_time_derivatives(model, work);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        double k = train.coupling.stiffness[c];
        add_outer(work.stiffness, train.coupling.ends[c], ENDS, 2, k);
        add_outer(work.system, train.coupling.ends[c], ENDS, 2,
                  train.coupling.damping[c] + step * k);
    }
    if constexpr (MOVING) assemble_bearings(train, state, step, work);
    if (train.friction) {
        if (first.pairs.has_bristles)
            bristle_damping(train, first.pairs, step, work.row, work.system);
        else
            friction_damping(train, first.pairs, first.force, h, work.row, work.system);
    }
    drag_damping(model, state, first.now.normal_force, first.force, h, work.system);
    for (std::int64_t j = 0; j <= train.bodies; ++j) work.system[j][j] += train.body.mass[j] / step;
    free_given(model, h, work);
}

// Add the forces on the members of such shafts by the known motion of the ends in a stage.
void add_given_motion_forces(const Model& model, double h, double* right) {
    const Train& train = model.train;
    const double step = GAMMA * h;
    for (std::int64_t c = 0; c < train.machines; ++c) {
        if (model.operation.port[c] != BY_MOTION) continue;
        std::int64_t body = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        double factor = train.coupling.damping[c] + step * train.coupling.stiffness[c];
        right[member] += factor * right[body] * step / train.body.mass[body];
    }
}

// Bodies and trim at stage i, and the contributions of earlier stages to its right-hand sides.
void place_stage(const Train& train, const State& state, double h, int i, Workspace& work) {
    for (std::int64_t j = 0; j <= train.bodies; ++j) {
        double x = state.x[j], v = state.v[j], cx = 0.0, cv = 0.0;
        for (int s = 0; s < i; ++s) {
            x += STAGE.a[i][s] * work.ux[s][j];
            v += STAGE.a[i][s] * work.uv[s][j];
            cx += STAGE.c[i][s] * work.ux[s][j];
            cv += STAGE.c[i][s] * work.uv[s][j];
        }
        work.x[j] = x;
        work.v[j] = v;
        work.rx[j] = v + cx / h;
        work.rv[j] = train.body.mass[j] * cv / h;
    }
    for (std::int64_t a = 0; a < train.axes; ++a) {
        work.trim[a] = state.trim[a];
        for (int s = 0; s < i; ++s) work.trim[a] += h * ALPHA[i][s] * work.trim_rate[s][a];
    }
}

// Contributions of stage i to the ledger and the trim.
void add_stage(const Train& train, const State& state, const StepConstants& constants, double h,
               int i, const Evaluation& out, Workspace& work) {
    for (std::int64_t a = 0; a < train.axes; ++a) {
        double speed = body_speed(train, state, work.v, train.coupling.ends[2 * a][0]);
        double set_speed = state.set_speed[a] + constants.slew[a] * STAGE.abscissa[i] * h;
        work.trim_rate[i][a] = set_speed - speed;
    }
    for (int e = 0; e < LEDGER; ++e) work.energy[e] += h * B[i] * out.power[e];
    for (std::int64_t c = 0; c < train.machines; ++c)
        work.machine_displacement[c] += h * B[i] * work.v[train.coupling.ends[c][0]];
}

// Stage i: evaluate, then solve for ux[i] and uv[i].
void make_stage(const Model& model, const State& state, const StepConstants& constants, double h,
                int i, Evaluation& first, Workspace& work) {
    const Train& train = model.train;
    const std::int64_t bodies = train.bodies + 1;
    const double g = 1.0 / (GAMMA * h);
    place_stage(train, state, h, i, work);
    Evaluation& out = i == 0 ? first : work.evaluation;
    if (i > 0) {
        advance_bristles(out.pairs, state.bristle, STAGE.a[i], work.bristle_stage, i);
        forces(model, state, constants, work.x, work.v, STAGE.abscissa[i] * h, work.trim, out);
    }
    add_stage(train, state, constants, h, i, out, work);
    double* right = work.uv[i];
    for (std::int64_t j = 0; j < bodies; ++j) {
        double value =
            out.force[j] + work.rv[j] + h * STAGE.time_weight[i] * work.time_derivative[j];
        for (std::int64_t k = 0; k < bodies; ++k) value -= work.stiffness[j][k] * work.rx[k] / g;
        right[j] = value;
    }
    if (first.pairs.has_bristles)
        add_bristle_forces(train, first.pairs, out.pairs, h, GAMMA * h, STAGE.c[i], i, right, work);
    add_given_motion_forces(model, h, right);
    solve(work.system, bodies - 1, right);
    right[bodies - 1] = 0.0;
    for (std::int64_t j = 0; j < bodies; ++j) work.ux[i][j] = (work.rx[j] + right[j]) / g;
    work.ux[i][bodies - 1] = 0.0;
    if (first.pairs.has_bristles) solve_bristles(train, first.pairs, GAMMA * h, right, i, work);
}

void begin_sums(const State& state, State& out, Workspace& work) {
    std::memset(work.energy, 0, sizeof work.energy);
    std::memset(work.machine_displacement, 0, sizeof work.machine_displacement);
    std::memset(work.error_x, 0, sizeof work.error_x);
    std::memset(work.error_v, 0, sizeof work.error_v);
    std::memset(work.error_bristle, 0, sizeof work.error_bristle);
    std::memcpy(out.x, state.x, sizeof out.x);
    std::memcpy(out.v, state.v, sizeof out.v);
    std::memcpy(out.bristle, state.bristle, sizeof out.bristle);
    std::memcpy(out.trim, state.trim, sizeof out.trim);
}

// Add stage i to the new state and the local errors.
void sum_stage(const Model& model, double h, int i, const Evaluation& first, State& out,
               Workspace& work) {
    const Train& train = model.train;
    for (std::int64_t a = 0; a < train.axes; ++a) out.trim[a] += h * B[i] * work.trim_rate[i][a];
    for (std::int64_t j = 0; j <= train.bodies; ++j) {
        out.x[j] += STAGE.weight[i] * work.ux[i][j];
        out.v[j] += STAGE.weight[i] * work.uv[i][j];
        work.error_x[j] += STAGE.error_weight[i] * work.ux[i][j];
        work.error_v[j] += STAGE.error_weight[i] * work.uv[i][j];
    }
    if (!first.pairs.has_bristles) return;
    for (std::int64_t k = 0; k < first.pairs.count; ++k) {
        out.bristle[k] += STAGE.weight[i] * work.bristle_stage[i][k];
        work.error_bristle[k] += STAGE.error_weight[i] * work.bristle_stage[i][k];
    }
}

}  // namespace

void add_machine_work(const Train& train, const State& state, double h, const State& out,
                      Workspace& work) {
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t body = train.coupling.ends[c][0];
        double force = work.energy[IMPULSE + c] / (h * train.body.radius[body]);
        work.energy[WORK + c] +=
            force * (out.x[body] - state.x[body] - work.machine_displacement[c]);
    }
}

void rosenbrock_step(const Model& model, const State& state, const StepConstants& constants,
                     double h, Evaluation& first, State& out, Workspace& work) {
    assemble(model, state, constants, h, first, work);
    factorise(work.system, model.train.bodies);
    begin_sums(state, out, work);
    for (int i = 0; i < STAGES; ++i) {
        make_stage(model, state, constants, h, i, first, work);
        sum_stage(model, h, i, first, out, work);
    }
    add_machine_work(model.train, state, h, out, work);
}

}  // namespace gearbox
