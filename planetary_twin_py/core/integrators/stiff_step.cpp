#include "integrators/stiff_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "integrators/edges.hpp"
#include "integrators/flanks.hpp"
#include "integrators/frame.hpp"
#include "integrators/methods.hpp"
#include "integrators/rosenbrock.hpp"
#include "integrators/step_growth.hpp"
#include "integrators/trial_step.hpp"
#include "lubrication/bristles.hpp"
#include "lubrication/tooth_friction.hpp"
#include "mesh/deflection.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace {

constexpr double STIFF = 3.0;  // weight of the errors
// Allowed error of the share of friction of a pair with bristles, relative to the tolerance.
constexpr double BRISTLE_SHARE = 1.0;
constexpr double ROUNDING = 1e-15;       // [m/s] smaller errors of a speed are neglected
constexpr std::int64_t EVALUATIONS = 4;  // of the equations of motion in a step
constexpr double DIVERGED = std::numeric_limits<double>::infinity();

// One step of h from `begin` into `end`, regardless of events.
void try_step(const Model& model, Integrator& integrator, double h) {
    const State& begin = integrator.begin;
    State& end = integrator.end;
    end = begin;
    trial_step(model, integrator, h, end);
    advance_clock(model, integrator, h);
    for (int e = 0; e < LEDGER; ++e) end.energy[e] = begin.energy[e] + integrator.work.energy[e];
    place_bristles(integrator.last.pairs, end.bristle);
    forces(model, begin, integrator.constants, end.x, end.v, h, end.trim, integrator.last);
    integrator.control.evaluations += EVALUATIONS;
}

// Largest local error of a mesh or of the speed of a body, relative to its tolerance. Infinite if
// the step diverged: a comparison with NaN would accept it.
double error_norm(const Model& model, const Integrator& integrator) {
    const Train& train = model.train;
    const Workspace& work = integrator.work;
    const Control& control = integrator.control;
    double largest = 0.0, total = 0.0;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double tau = integrator.constants.tau[train.mesh.kind[i]];
        double error = std::fabs(mesh_motion(train, i, work.error_x));
        // By damping, an error of the rate causes k tau times that error of the force.
        double slip = std::max(std::fabs(mesh_motion(train, i, work.error_v)) - ROUNDING, 0.0);
        largest = std::max(largest, std::max(error, tau * slip) / control.tolerance_x);
    }
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        largest = std::max(largest, std::fabs(work.error_v[j]) / control.tolerance_v);
        total += work.error_v[j];
    }
    for (std::int64_t k = 0; control.creeping && k < train.teeth.slots * train.meshes; ++k) {
        double error = std::fabs(work.error_bristle[k]);
        largest = std::max(largest, error / (BRISTLE_SHARE * control.tolerance));
        total += error;
    }
    return std::isfinite(total) ? largest : DIVERGED;
}

struct Controlled {
    double step;
    double factor;  // for the length of the next step
};

// Try steps, the first of h, until the error is allowed.
Controlled controlled_step(const Model& model, Integrator& integrator, double h) {
    while (true) {
        try_step(model, integrator, h);
        double error = STIFF * error_norm(model, integrator);
        double factor = growth_of_step(error, ROSENBROCK_ORDER);
        if (error <= 1.0 || (h <= SHORTEST_STEP && error < DIVERGED)) return {h, factor};
        if (h <= SHORTEST_STEP) throw NoFiniteState{};
        ++integrator.control.rejected;
        h = std::max(h * std::max(SHRINK, factor), SHORTEST_STEP);
    }
}

// Add the increase of the elastic energy of the bristles to the work of changing stiffness, which
// then is what the deformation of the bristles does not explain: their stiffness changes with the
// load of their pairs.
void book_bristles(const Model& model, Integrator& integrator) {
    State& end = integrator.end;
    double energy = bristle_energy(model.train, model.oil, integrator.last.pairs);
    end.energy[STIFFNESS_WORK] += energy - end.presliding;
    end.presliding = energy;
}

// Forces at the start of the step.
void find_first_forces(const Model& model, Integrator& integrator) {
    Control& control = integrator.control;
    const State& begin = integrator.begin;
    Evaluation &first = integrator.first, &last = integrator.last;
    if (control.changed || control.collocated) {
        place_bristles(first.pairs, begin.bristle);
        forces(model, begin, integrator.constants, begin.x, begin.v, 0.0, begin.trim, first);
        ++control.evaluations;
        control.changed = false;
    } else {  // forces do not depend on the frame in which x is measured
        std::memcpy(first.force, last.force, sizeof first.force);
        std::memcpy(first.power, last.power, sizeof first.power);
        std::memcpy(first.now.normal_force, last.now.normal_force, sizeof first.now.normal_force);
        copy_friction(last.pairs, first.pairs);
    }
}

}  // namespace

std::int64_t stiff_step(const Model& model, Integrator& integrator, double longest, double event) {
    Control& control = integrator.control;
    find_first_forces(model, integrator);
    control.collocated = false;
    double trial = std::min(planned(event, std::min(control.next_stiff, longest), 1.0), longest);
    auto [h, factor] = controlled_step(model, integrator, trial);
    double candidate = h * std::min(GROW, std::max(SHRINK, factor));
    // A step shortened by an event does not determine the length of the next ones.
    control.next_stiff = factor >= 1.0 ? std::max(candidate, control.next_stiff) : candidate;
    control.fallback_steps = std::max<std::int64_t>(control.fallback_steps - 1, 0);
    ++control.stiff_steps;
    FlankEvent flank = first_flank_event(model, integrator);
    if (flank.mesh != NO_MESH && h > SHORTEST_STEP && !at_event(model, integrator, flank.mesh))
        try_step(model, integrator, std::max(flank.when, SHORTEST_STEP));
    if (control.creeping) book_bristles(model, integrator);
    return flank.mesh;
}

}  // namespace gearbox
