#include "quasi_static/statics.hpp"

#include <algorithm>
#include <cmath>

#include "capacities.hpp"
#include "model/set_step_constants.hpp"
#include "quasi_static/equilibrium.hpp"
#include "quasi_static/machines.hpp"
#include "quasi_static/planet_load.hpp"

namespace gearbox {

namespace {

// A planet as a spring between sun and ring.
void place_spring(const Train& train, Equilibrium& run, std::int64_t p) {
    Springs& springs = run.springs;
    std::int64_t s = p, r = train.meshes / 2 + p;
    springs.copies[p] = train.mesh.copies[p];
    double friction = springs.friction[p] =
        run.external[train.mesh.body[p][1]] / train.mesh.copies[p];
    springs.compliance[p] = 1.0 / run.stiffness[s] + 1.0 / run.stiffness[r];
    springs.error[p] = run.error[s] + run.error[r] + friction / run.stiffness[s];
    double* steps = springs.steps[p];
    steps[0] = -run.clearance[s][COAST_CLEARANCE] - run.clearance[r][COAST_CLEARANCE];
    steps[2] = run.clearance[s][DRIVE_CLEARANCE] + run.clearance[r][DRIVE_CLEARANCE];
    steps[1] = friction > 0.0
                   ? run.clearance[s][DRIVE_CLEARANCE] - run.clearance[r][COAST_CLEARANCE]
                   : run.clearance[r][DRIVE_CLEARANCE] - run.clearance[s][COAST_CLEARANCE];
}

// Set the sides of the meshes by the signs of their forces.
void choose_sides(const Train& train, Equilibrium& run) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double force = run.force[i];
        run.state.side[i] = force == 0.0 ? OPEN : force > 0.0 ? DRIVE_SIDE : COAST_SIDE;
        if (static_cast<double>(run.state.side[i]) != run.step.side[i])
            copy_segment(train, run.state, run.step, i);
    }
}

// Factor of the carrier's x in w, the sum of the transmission errors of a planet's two meshes.
double carrier_factor(const Train& train) {
    return train.mesh.sign[0][2] + train.mesh.sign[train.meshes / 2][2];
}

// Displace couplings and members by their loads; w [m] is the lag of the ring behind the sun.
void displace_by_windup(const Train& train, Equilibrium& run, double w) {
    double* x = run.state.x;
    std::int64_t planets = train.meshes / 2, loaded = train.coupling.ends[LOAD_MACHINE][1];
    x[loaded] = 0.0;
    for (std::int64_t c = 0; c < train.machines; c += 2) {  // the motors are fixed to their frame
        std::int64_t machine = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        x[member] = -run.external[machine] / train.coupling.stiffness[c];
    }
    x[train.bodies] = 0.0;
    double wound =
        x[train.sun] + x[train.mesh.body[planets][1]] + carrier_factor(train) * x[train.carrier];
    x[loaded] = (w - wound) / (loaded == train.carrier ? carrier_factor(train) : 1.0);
}

// d [m] of a mesh under its force.
double stretch(const Equilibrium& run, std::int64_t i) {
    double clearance =
        run.force[i] > 0.0 ? run.clearance[i][DRIVE_CLEARANCE] : -run.clearance[i][COAST_CLEARANCE];
    return run.error[i] + clearance + run.force[i] / run.stiffness[i];
}

// d [m] of the sun mesh of an idle planet in the middle of its backlash; w [m]: wind-up.
double idle_deflection(const Equilibrium& run, std::int64_t p, double w) {
    double low = run.springs.steps[p][0], high = run.springs.steps[p][2];
    double passed = w - run.springs.error[p] - low;
    passed = high > low ? passed / (high - low) : 0.0;
    double both = run.clearance[p][DRIVE_CLEARANCE] + run.clearance[p][COAST_CLEARANCE];
    return run.error[p] - run.clearance[p][COAST_CLEARANCE] + passed * both;
}

}  // namespace

void put_external(const Model& model, Equilibrium& run) {
    const Train& train = model.train;
    std::copy_n(run.evaluation.friction_force, train.bodies, run.external);
    balance_torques(model, run);
    for (std::int64_t c = 0; c < train.machines; ++c) {
        std::int64_t machine = train.coupling.ends[c][0], member = train.coupling.ends[c][1];
        run.external[member] += run.external[machine];
    }
}

double solve_load_sharing(const Model& model, Equilibrium& run) {
    const Train& train = model.train;
    std::int64_t planets = train.meshes / 2, ring = train.mesh.body[planets][1];
    bool sun_turns = train.sun != train.bodies;
    double total = run.external[sun_turns ? train.sun : ring], copies = 0.0;
    for (std::int64_t p = 0; p < planets; ++p) {
        place_spring(train, run, p);
        copies += train.mesh.copies[p];
        if (sun_turns) total -= train.mesh.copies[p] * run.springs.friction[p];
    }
    double w = solve_windup(total, planets, run.springs);
    for (std::int64_t p = 0; p < planets; ++p) {
        run.force[planets + p] = planet_force(run.springs, p, w).force;
        run.force[p] = run.force[planets + p] + run.springs.friction[p];
    }
    choose_sides(train, run);
    displace_by_windup(train, run, w);
    return std::abs(total) / copies;
}

void place_planets(const Model& model, Equilibrium& run) {
    const Train& train = model.train;
    double* x = run.state.x;
    std::int64_t planets = train.meshes / 2;
    double sun = x[train.sun], ring = x[train.mesh.body[planets][1]], carrier = x[train.carrier];
    for (std::int64_t p = 0; p < planets; ++p) {
        double d, w = sun + ring + carrier_factor(train) * carrier;
        if (run.force[p] != 0.0)
            d = stretch(run, p);
        else if (run.force[planets + p] != 0.0)
            d = w - stretch(run, planets + p);
        else
            d = idle_deflection(run, p, w);
        x[train.mesh.body[p][1]] = d - sun + carrier;
    }
}

}  // namespace gearbox
