#pragma once

// Forces on the train at a node of a collocation step.

#include "integrators/propagation.hpp"
#include "lubrication/mesh_friction.hpp"
#include "mesh/mesh_forces.hpp"
#include "model/equations.hpp"

namespace gearbox {

// Lowest tolerance for friction in single precision, whose error is negligible there.
inline constexpr double SINGLE_PRECISION = 1e-5;
// The same for samples: errors of film thicknesses are below a hundredth of the tolerance, as
// required by the polynomials of `sample_table.cpp`.
inline constexpr double SINGLE_PRECISION_SHOWN = 5e-4;

// Number of nodes of most steps.
inline constexpr int TOGETHER = 4;

// Forces of the meshes at a node.
template <int L>
NOINLINE void find_forces_at_node(const Model& model, const Integrator& integrator, Node& node,
                                  double delay) {
    constexpr int M = MESH_LANES<L>;
    copy<M>(node.d, node.meshes.d);
    copy<M>(node.rate, node.meshes.rate);
    const StepConstants& constants = integrator.constants;
    place_meshes(model.train, integrator.begin, constants, node.x, node.v, delay, node.meshes);
    find_mesh_forces<M>(model, integrator.begin, constants, node.meshes);
    if (tilts(model.train)) tilt_flanks(model.train, constants, node.x, node.v, node.meshes);
}

// Friction and drag at a node as forces on the bodies, without the results of `find_friction`.
NOINLINE inline void find_friction_forces(const Model& model, const Integrator& integrator,
                                          Node& node, double* friction_force) {
    const Train& train = model.train;
    if (train.friction) add_friction_forces(train, node.friction.drag, friction_force);
    if (!has_drag(train)) return;
    for (int e : {BEARING, CHURNING, HEAT + HEAT_BEARINGS, HEAT + HEAT_SEALS, HEAT + HEAT_CHURNING})
        node.power[e] = 0.0;
    apply_drag(model, integrator.begin, node.v, node.meshes.normal_force, friction_force,
               node.power);
}

// Set the forces on bodies and ground to zero.
template <int L>
ALWAYS_INLINE void clear_bodies(const Train& train, double* force) {
    Row<L>(0.0).store(force);
    force[train.bodies] = 0.0;
}

// Friction and drag at a node in the modes, by way of the forces on the bodies.
template <int L>
ALWAYS_INLINE void find_body_friction(const Model& model, const Integrator& integrator,
                                      const ContactState& contacts, Node& node) {
    if (model.train.printed_torque)
        print_torques(model.train, integrator.constants, node.v, node.friction.drag);
    alignas(64) double on_bodies[BODIES];
    clear_bodies<L>(model.train, on_bodies);
    find_friction_forces(model, integrator, node, on_bodies);
    sum_rows<L>(contacts.matrices.shapes_transposed(), on_bodies).store(node.friction_force);
}

// The same at COUNT nodes where axes are fixed and only the meshes have friction. The nodes share
// what is read of the matrices.
template <int COUNT, int L>
ALWAYS_INLINE void find_mesh_friction(const ContactState& contacts, Node* node) {
    const MatrixRows first = contacts.matrices.torque_to_modes(0);
    const MatrixRows second = contacts.matrices.torque_to_modes(1);
    RowPair<L> force[COUNT];
    for (RowPair<L>& of_node : force) of_node = {0.0, 0.0};
    for (std::int64_t i = 0; i < first.count; ++i)
        for (int n = 0; n < COUNT; ++n) {
            const double (*torque)[MESHES] = node[n].friction.drag.torque;
            add_row(first.first + i * L, torque[0][i] - Lanes{}, force[n].first);
            add_row(second.first + i * L, torque[1][i] - Lanes{}, force[n].second);
        }
    for (int n = 0; n < COUNT; ++n)
        (force[n].first + force[n].second).store(node[n].friction_force);
}

// Friction and drag at the first `count` nodes in the modes.
template <int L>
ALWAYS_INLINE void find_modal_friction(const Model& model, const Integrator& integrator,
                                       const ContactState& contacts, int count, Node* node) {
    const Train& train = model.train;
    int n = 0;
    if (MOVING || !train.friction || train.printed_torque || has_drag(train))
        for (; n < count; ++n) find_body_friction<L>(model, integrator, contacts, node[n]);
    for (; n + TOGETHER <= count; n += TOGETHER)
        find_mesh_friction<TOGETHER, L>(contacts, node + n);
    for (; n < count; ++n) find_mesh_friction<1, L>(contacts, node + n);
}

// Friction and drag at all nodes, from the forces of the meshes there.
template <int L>
void find_friction_of_nodes(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    Propagation& run = integrator.run;
    const int count = static_cast<int>(run.nodes.count);
    if (train.friction) {
        FrictionInstant instants[MOST_NODES] = {};
        for (int n = 0; n < count; ++n) {
            Node& node = run.node[n];
            distribute_forces<MESH_LANES<L>>(train, integrator.constants, node.meshes);
            instants[n] = {&node.meshes, node.spin, &node.friction};
        }
        find_friction(model, integrator.constants, instants, count,
                      integrator.control.tolerance >= SINGLE_PRECISION);
    }
    find_modal_friction<L>(model, integrator, contacts_of(run), count, run.node);
}

// Forces of meshes, friction and machines at a node, in the modes.
template <int L>
NOINLINE Row<L> node_force(const Model& model, const Integrator& integrator,
                           const ContactState& contacts, double delay, Node& node) {
    using V = Row<L>;
    const Train& train = model.train;
    MachineForces forces;
    node.power[DAMPING] = node.power[STIFFNESS_WORK] = node.power[WEIGHT] = 0.0;
    apply_couplings(train, node.x, node.v, forces, node.power);
    apply_machines(model, integrator.begin, integrator.constants, node.x, node.v, delay, node.trim,
                   forces, node.power);
    using OfMeshes = Row<MESH_LANES<L>>;
    const MatrixRows share = contacts.matrices.shapes_transposed();
    OfMeshes normal_force =
        OfMeshes(integrator.constants.side) * OfMeshes(node.meshes.normal_force);
    V force =
        V(node.friction_force) + sum_rows<L>(contacts.matrices.force_to_modes(), normal_force);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        force += V(share[train.coupling.ends[c][0]]) * forces.machine[c];
        force += V(share[train.coupling.ends[c][1]]) * forces.member[c];
    }
    if constexpr (MOVING) {
        alignas(64) double on_axes[BODIES];
        clear_bodies<L>(train, on_axes);
        apply_axes(train, integrator.begin, integrator.constants.rigid, delay, node.x, node.v,
                   on_axes, node.power);
        if (tilts(train)) add_slope_moments(train, node.meshes, on_axes);
        force += sum_rows<L>(share, on_axes);
    }
    return force;
}

// Motion and mesh forces at a time within the step.
template <int L>
void show_meshes(const Model& model, const Integrator& integrator, double delay, Node& node) {
    Waves<L> at = waves_at<L>(integrator.run.motion, delay);
    move_node<L>(model, integrator, delay, at.cosine, at.sine, node);
    find_forces_at_node<L>(model, integrator, node, delay);
}

// The same at several times, at most MOST_INSTANTS, in `run.shown`; if asked for, with friction.
template <int L>
void show_nodes(const Model& model, Integrator& integrator, const double* delays, int count,
                bool friction = true) {
    FrictionInstant instants[MOST_INSTANTS] = {};
    for (int n = 0; n < count; ++n) {
        Node& node = integrator.run.shown[n];
        show_meshes<L>(model, integrator, delays[n], node);
        distribute_forces<MESH_LANES<L>>(model.train, integrator.constants, node.meshes);
        instants[n] = {&node.meshes, node.spin, &node.friction};
    }
    if (friction)
        find_friction(model, integrator.constants, instants, count,
                      integrator.control.tolerance >= SINGLE_PRECISION_SHOWN);
}

}  // namespace gearbox
