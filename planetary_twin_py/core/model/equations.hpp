#pragma once

// Equations of motion: forces on every body, and the powers of the energy ledger.
//
// J_s th_s'' = T_s - r_bs sum F_sp + Q_s and so on for every body (Salagianni et al. 2017, eqs.
// (18)-(20), with friction as the generalised force Q_j = -f dVs/dw_j instead of P/w). In the
// coordinates x = r theta all mesh forces enter with the signs of `Train.mesh.sign`.

#include <numbers>

#include "lubrication/tooth_friction.hpp"
#include "mesh/mesh_forces.hpp"
#include "model/axes_forces.hpp"
#include "model/drag.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Add the friction torques of all meshes as forces on the bodies.
inline void add_friction_forces(const Train& train, const DragOfMeshes& drag,
                                double* friction_force) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (MOVING && drag.torque[0][i] == 0.0 && drag.torque[1][i] == 0.0) continue;
        for (int j = 0; j < GEARS; ++j) {
            double force = drag.torque[j][i] * train.mesh.lever[j][i];
            friction_force[train.mesh.body[i][j]] += train.mesh.copies[i] * force;
        }
        for (int j = GEARS; j < IN_PLANE; ++j)
            friction_force[train.mesh.body[i][j]] +=
                train.mesh.copies[i] * drag.torque[2][i] * train.moving.line[i][j];
    }
}

// Power lost to the friction of all meshes [W].
inline double friction_power(const Train& train, const DragOfMeshes& drag) {
    double power = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i) power += train.mesh.copies[i] * drag.power[i];
    return power;
}

// Add the power lost to the friction of the meshes of each kind [W].
inline void add_heat_of_meshes(const Train& train, const DragOfMeshes& drag, double* heat) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        heat[train.mesh.kind[i] == 0 ? HEAT_SUN_MESHES : HEAT_RING_MESHES] +=
            train.mesh.copies[i] * drag.power[i];
}

// Friction of the tooth pairs and its sums over those of each mesh, from the forces of the meshes.
inline void find_friction_of_pairs(const Model& model, const StepConstants& step, const double* v,
                                   Evaluation& out) {
    share_loads(model, step, out);
    turn_pairs(model.train, step, v, out.pairs);
    evaluate(model, out.pairs);
    collect(model.train, out.pairs, out.friction);
}

// Friction of the tooth pairs and drag in out.friction_force, from the forces of the meshes.
inline void apply_friction(const Model& model, const State& state, const StepConstants& step,
                           const double* v, Evaluation& out) {
    const Train& train = model.train;
    for (double& force : out.friction_force) force = 0.0;
    if (train.friction) {
        DragOfMeshes& drag = out.friction.drag;
        find_friction_of_pairs(model, step, v, out);
        if (train.printed_torque) print_torques(train, step, v, drag);
        add_friction_forces(train, drag, out.friction_force);
        out.power[FRICTION] += friction_power(train, drag);
        add_heat_of_meshes(train, drag, out.power + HEAT);
        out.power[STIFFNESS_WORK] -= deforming_power(train, out.pairs);  // see book_bristles
    }
    if (has_drag(train))
        apply_drag(model, state, v, out.now.normal_force, out.friction_force, out.power);
}

// Forces on the machines and the members coupled to them [N].
struct MachineForces {
    double machine[MACHINES];
    double member[MACHINES];
};

// Shafts between the machines and their members.
ALWAYS_INLINE void apply_couplings(const Train& train, const double* x, const double* v,
                                   MachineForces& forces, double* power) {
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t machine = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        double rate = v[machine] - v[member];
        double damping = train.coupling.damping[c] * rate;
        double total = train.coupling.stiffness[c] * (x[machine] - x[member]) + damping;
        forces.machine[c] = -total;
        forces.member[c] = total;
        power[DAMPING] += damping * rate;
    }
}

// Phase of the torque ripple of the first motor [rad], which follows the angle of its shaft.
ALWAYS_INLINE double ripple_phase(const Model& model, const State& state, const double* x,
                                  double delay) {
    const std::int64_t body = model.train.coupling.ends[MOTOR][0];
    double angle = 2.0 * std::numbers::pi * state.fraction[0] + state.speed[0] * delay;
    angle += x[body] / model.train.body.radius[body];
    return model.operation.ripple_order * angle;
}

// Add the torques of the motors, which control their speeds, and of the load; or given ones.
//
// The torque of a shaft with given motion is that of its coupling. The force here accelerates the
// mass of its end as given: the inertia of the drive is not part of the train.
ALWAYS_INLINE void apply_machines(const Model& model, const State& state, const StepConstants& step,
                                  const double* x, const double* v, double delay,
                                  const double* trim, MachineForces& forces, double* power) {
    const Train& train = model.train;
    const Operation& operation = model.operation;
    for (std::int64_t c = 0; c < train.machines; ++c) {
        const std::int64_t body = train.coupling.ends[c][0];
        const Drive& drive = step.drive[c];
        const double spin = v[body] * train.body.inverse_radius[body],
                     speed = step.rigid[body] + spin;
        double torque = drive.torque + drive.rate * delay - drive.gain * spin;
        for (std::int64_t a = 0; a < train.axes; ++a) torque += operation.trim_gain[c][a] * trim[a];
        if (c == MOTOR && operation.ripple != 0.0)
            torque += operation.ripple * sin_cos(ripple_phase(model, state, x, delay)).sine;
        double force = torque * train.body.inverse_radius[body];
        if (operation.port[c] == BY_MOTION) {
            torque = -forces.machine[c] * train.body.radius[body];
            forces.machine[c] = 0.0;
            force = train.body.mass[body] * train.body.radius[body] * operation.acceleration[c];
        }
        forces.machine[c] += force;
        power[WORK + c] = torque * speed;
        power[IMPULSE + c] = torque;
    }
}

// Add the forces of the meshes to those on the bodies.
ALWAYS_INLINE void add_mesh_forces(const Train& train, const State& state, const MeshesNow& now,
                                   double* force) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double normal_force =
            train.mesh.copies[i] * static_cast<double>(state.side[i]) * now.normal_force[i];
        for (int j = 0; j < entries_of(train); ++j)
            force[train.mesh.body[i][j]] -= normal_force * train.mesh.sign[i][j];
    }
}

// Add forces on the machines and the members to those on the bodies.
ALWAYS_INLINE void add_at_shafts(const Train& train, const MachineForces& forces, double* force) {
    for (std::int64_t c = 0; c < train.machines; ++c) {
        force[train.coupling.ends[c][0]] += forces.machine[c];
        force[train.coupling.ends[c][1]] += forces.member[c];
    }
}

// Sum of all forces: meshes, friction and drag, couplings, machines.
inline void assemble_forces(const Model& model, const State& state, const StepConstants& step,
                            const double* x, const double* v, double delay, const double* trim,
                            Evaluation& out) {
    const Train& train = model.train;
    for (int j = 0; j < BODIES; ++j) out.force[j] = out.friction_force[j];
    add_mesh_forces(train, state, out.now, out.force);
    MachineForces forces;
    apply_couplings(train, x, v, forces, out.power);
    apply_machines(model, state, step, x, v, delay, trim, forces, out.power);
    add_at_shafts(train, forces, out.force);
    if constexpr (MOVING) {
        apply_axes(train, state, step.rigid, delay, x, v, out.force, out.power);
        if (tilts(train)) add_slope_moments(train, out.now, out.force);
    }
    out.force[train.bodies] = 0.0;  // the ground
}

// Forces on all bodies in coordinates x, `delay` seconds after the start of a step.
//
// `state` gives the sides in contact, the segments and x at the start.
inline void forces(const Model& model, const State& state, const StepConstants& step,
                   const double* x, const double* v, double delay, const double* trim,
                   Evaluation& out) {
    move_meshes(model.train, x, v, out.now);
    mesh_forces(model, state, step, x, v, delay, out);
    apply_friction(model, state, step, v, out);
    assemble_forces(model, state, step, x, v, delay, trim, out);
}

}  // namespace gearbox
