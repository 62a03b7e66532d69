// The meshes as springs of static equilibrium.

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/cycle.hpp"
#include "mesh/deflection.hpp"
#include "mesh/form_errors.hpp"
#include "mesh/stiffness.hpp"
#include "model/set_step_constants.hpp"
#include "quasi_static/equilibrium.hpp"
#include "quasi_static/statics.hpp"

namespace gearbox {

namespace {

constexpr double LEAST_STIFFNESS = 1e-9;  // of a healthy mesh, at the entry of its only pair

// A spring and the deflection at which it starts.
struct Spring {
    double stiffness;  // [N/m]
    double gap;        // missing material [m]
};

// Close every mesh: an open one on the side on which it would close.
void close_meshes(const Train& train, Equilibrium& run) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        std::int64_t& side = run.state.side[i];
        if (side != OPEN) run.closing_side[i] = side;
        side = run.closing_side[i];
    }
}

// The loaded pairs of mesh i as one spring, pair by pair, since each may have faults.
Spring faulty_spring(const Model& model, const Equilibrium& run, std::int64_t i, double healthy) {
    const Train& train = model.train;
    const StepConstants& step = run.step;
    std::int64_t segment = run.state.segment[i], kind = train.mesh.kind[i],
                 side = run.state.side[i];
    double u = step.start[i] - train.teeth.edge[kind][segment];
    double deflection = side * (mesh_motion(train, i, run.state.x) - run.error[i]);
    deflection -= run.clearance[i][side == DRIVE_SIDE ? DRIVE_CLEARANCE : COAST_CLEARANCE];
    std::int64_t count = train.teeth.present[kind][segment];
    double least = std::numeric_limits<double>::infinity();
    for (std::int64_t p = 0; p < count; ++p)
        least = std::min(least, fault_effect(train, step, i, segment, p, u).gap);
    double total = total_weight(train, kind, segment, u).value;
    double stiffness = 0.0, first = 0.0;
    for (std::int64_t p = 0; p < count; ++p) {
        auto effect = fault_effect(train, step, i, segment, p, u);
        if (effect.gap > std::max(deflection, least)) continue;
        double weight =
            polynomial(train.teeth.weight[kind][segment][p], u, train.teeth.terms).value;
        double k = std::max(healthy * effect.factor * weight / total, LEAST_STIFFNESS * healthy);
        stiffness += k;
        first += k * effect.gap;
    }
    return {stiffness, first / stiffness};
}

}  // namespace

void place_springs(const Model& model, Equilibrium& run) {
    const Train& train = model.train;
    const StepConstants& step = run.step;
    close_meshes(train, run);
    find_tooth_pairs(model, run.state, run.step);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        run.error[i] = form_error(train, i, 0.0, step.line_angle, 0.0, 0.0).length;
        double clearance = model.operation.backlash.offset +
                           radial_error(train, i, step.line_angle, 0.0, 0.0).length;
        int carrying = run.state.side[i] == DRIVE_SIDE ? DRIVE_CLEARANCE : COAST_CLEARANCE;
        // Negative only with a regulatory factor, whose forces grow from zero deflection; the gap
        // of a flank without load is positive.
        run.clearance[i][DRIVE_CLEARANCE] = run.clearance[i][COAST_CLEARANCE] = std::abs(clearance);
        run.clearance[i][carrying] = clearance;
        Spring spring{mesh_stiffness(train, i, run.state.segment[i], step.start[i]), 0.0};
        if (train.faults.count > 0) spring = faulty_spring(model, run, i, spring.stiffness);
        run.stiffness[i] = spring.stiffness;
        run.clearance[i][carrying] += spring.gap;
    }
}

}  // namespace gearbox
