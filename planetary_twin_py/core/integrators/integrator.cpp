#include "integrators/integrator.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/collocated_step.hpp"
#include "integrators/creep.hpp"
#include "integrators/cycle_samples.hpp"
#include "integrators/damage_of_step.hpp"
#include "integrators/edges.hpp"
#include "integrators/frame.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/methods.hpp"
#include "integrators/periodic.hpp"
#include "integrators/progress.hpp"
#include "integrators/step_sums.hpp"
#include "integrators/stiff_step.hpp"
#include "integrators/window_sums.hpp"
#include "lubrication/tooth_friction.hpp"
#include "mesh/both_flanks.hpp"
#include "mesh/contact_change.hpp"
#include "mesh/deflection.hpp"
#include "mesh/join_flanks.hpp"
#include "model/set_step_constants.hpp"

namespace gearbox {

namespace {

// Allowed errors of speeds relative to the range in which friction reverses, in tolerances: where
// pairs slide, and where they have bristles and gears may stick and slip.
constexpr double SLIDING_SHARE = 60.0, CREEPING_SHARE = 1.0;
constexpr double AT_TARGET =
    1e-12;  // [s] of the slew rate, by which a set-point may miss its target

// Largest allowed error of a transmission error, in tolerances of the elastic deflection. Without
// it, errors would be relative to half the backlash, which flanks that stay in contact do not
// cross: forces would be wrong by many times the tolerance.
constexpr double MOST_OF_ELASTIC = 10.0;

// Whether flanks part: some have, and those of a mesh are apart.
bool flanks_part(const Train& train, const Integrator& integrator) {
    const State& state = integrator.begin;
    if (integrator.control.flank_events == 0) return false;
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        const bool other = MOVING && state.side[other_flank(train, i)] != OPEN;
        if (state.side[i] == OPEN && !other) return true;
    }
    return false;
}

// Largest deflection of a mesh beyond half the backlash [m].
double largest_squeeze(const Model& model, const State& state) {
    double largest = 0.0;
    for (std::int64_t i = 0; i < model.train.meshes; ++i)
        largest = std::max(largest, std::fabs(mesh_motion(model.train, i, state.x)));
    return largest - model.operation.backlash.half;
}

// Allow errors in proportion to the deflection of the meshes by torques or by inertia.
//
// Friction reverses within a small range of sliding speeds, which limits errors of speeds where the
// gears turn slowly.
void set_tolerances(const Model& model, Integrator& integrator) {
    const Train& train = model.train;
    Control& control = integrator.control;
    double by_inertia = 0.0;
    for (std::int64_t a = 0; a < train.axes; ++a)
        by_inertia += control.acceleration_deflection[a] * std::fabs(integrator.constants.slew[a]);
    double deflection = control.deflection + by_inertia;
    double elastic = control.elastic_deflection + by_inertia;
    if (deflection > MOST_OF_ELASTIC * elastic && !flanks_part(train, integrator)) {
        elastic = std::max(elastic, largest_squeeze(model, integrator.begin));
        deflection = std::min(deflection, MOST_OF_ELASTIC * elastic);
    }
    control.tolerance_x = control.tolerance * deflection;
    control.tolerance_v = control.tolerance_x * control.speed_per_deflection;
    if (!train.friction) return;
    double share = control.creeping ? CREEPING_SHARE : SLIDING_SHARE;
    double layer = friction_layer(train, model.oil, integrator.constants.cycle_rate);
    double allowed = share * control.tolerance * layer;
    control.friction_limits_speed = allowed < control.tolerance_v;
    control.tolerance_v = std::min(control.tolerance_v, allowed);
}

// End the slewing of set-points that have reached their targets.
void end_slews(const Model& model, Integrator& integrator) {
    for (std::int64_t a = 0; a < model.train.axes; ++a) {
        double gap = model.operation.target_speed[a] - integrator.end.set_speed[a];
        double slew = integrator.constants.slew[a];
        if (gap * slew <= 0.0 || std::fabs(gap) < AT_TARGET * model.operation.slew_rate) {
            integrator.end.set_speed[a] = model.operation.target_speed[a];
            integrator.control.changed |= slew != 0.0;
        }
    }
}

// Write the samples that are due up to the end of the last step.
void write_due_samples(const Model& model, Integrator& integrator, Grid& grid) {
    auto& [next, out, taken] = grid;
    double delays[MOST_INSTANTS];
    while (!grid.full() && delay(integrator.end, due(next)) <= 0.0) {
        if (integrator.periodic.replaying) {
            sample_cycle(model, integrator, due(next), out, taken++);
            next = after(next);
            continue;
        }
        int count = 0;
        while (count < MOST_INSTANTS && taken + count < out.rows &&
               delay(integrator.end, due(next)) <= 0.0) {
            delays[count++] = delay(integrator.begin, due(next));
            next = after(next);
        }
        sample(model, integrator, delays, count, out, taken);
        taken += count;
    }
}

}  // namespace

void begin_step(const Model& model, Integrator& integrator) {
    if (integrator.control.creeping)
        integrator.begin = integrator.end;
    else
        copy_without_bristles(integrator.end, integrator.begin);
    with_lanes(model.train, [&](auto lanes) { rebase<lanes>(model.train, integrator.begin); });
    set_step_constants(model, integrator.begin, integrator.constants);
    select_friction_model(model, integrator);
    set_tolerances(model, integrator);
    avoid_reversals(model, integrator);
    if (both_flanks_touch(model, integrator.begin, integrator.constants))
        ++integrator.control.both_flanks;
}

void one_step(const Model& model, Integrator& integrator, double longest) {
    Control& control = integrator.control;
    integrator.sums.stale = control.changed || control.collocated || !integrator.sums.known;
    NextEvent event = next_event(model, integrator);
    longest = std::min(longest, control.longest);
    std::int64_t changing = FAILED;
    bool asked = control.method == AUTO || control.method == COLLOCATION;
    bool collocates = asked && !control.creeping;
    if (collocates && (control.fallback_steps == 0 || control.method == COLLOCATION)) {
        changing = collocated_step(model, integrator, longest, event);
        if (changing == FAILED) control.changed = true;
    }
    if (changing == FAILED) changing = stiff_step(model, integrator, longest, event.time);
    accept(model, integrator, changing);
}

void accept(const Model& model, Integrator& integrator, std::int64_t mesh) {
    integrator.sums.known = !integrator.sums.not_requested;
    if (integrator.sums.known) {
        sum_step(model, integrator);
        if (model.train.durability.active) count_damage(model, integrator);
    }
    if (mesh != NO_MESH) {
        change_contact(model, integrator.end, integrator.scratch, mesh);
        integrator.control.flank_events += static_cast<std::int64_t>(model.train.mesh.copies[mesh]);
        integrator.control.changed = true;
    }
    with_mesh_lanes(model.train, [&](auto lanes) { pass_edges<lanes>(model, integrator); });
    end_slews(model, integrator);
    ++integrator.control.steps;
}

void advance(const Model& model, Integrator& integrator, const Instant& until, const Instant& bound,
             std::span<Grid> grids) {
    Progress progress;
    while (true) {
        for (Grid& each : grids) write_due_samples(model, integrator, each);
        if (std::ranges::all_of(grids, &Grid::full) && delay(integrator.end, until) <= 0.0) return;
        progress.look(integrator);
        count_step(model, integrator);
        if (integrator.periodic.replaying) {
            replay_window(model, integrator, until, grids);
        } else {
            begin_step(model, integrator);
            one_step(model, integrator, delay(integrator.begin, bound));
            check_periodicity(model, integrator);
        }
    }
}

void advance(const Model& model, Integrator& integrator, const Instant& until, const Instant& bound,
             std::span<Grid> grids, const Samples& last) {
    advance(model, integrator, until, bound, grids);
    if (integrator.periodic.replaying)
        sample_cycle(model, integrator, until, last, 0);
    else
        sample(model, integrator, delay(integrator.begin, until), last, 0);
}

void interrupt(const Model& model, Integrator& integrator, const Instant& until) {
    if (!integrator.control.collocated || integrator.periodic.replaying)
        return cut(model, integrator, until);
    restart_settling(integrator);
    if (delay(integrator.end, until) < 0.0) {
        end_within(model, integrator, delay(integrator.begin, until));
        integrator.control.changed = false;
    }
    integrator.end.seconds = until.seconds;
    integrator.end.time = until.time;
    integrator.run.steps_in_contact_state =
        STORED_STEPS;  // stored steps start with the contact state
}

void cut(const Model& model, Integrator& integrator, const Instant& until) {
    restart_settling(integrator);
    if (delay(integrator.end, until) < 0.0) {
        integrator.end = integrator.begin;
        integrator.control.changed = true;
        Instant close{until.seconds, until.time - SHORTEST_STEP};
        while (delay(integrator.end, close) > 0.0) {
            count_step(model, integrator);
            begin_step(model, integrator);
            one_step(model, integrator, delay(integrator.begin, until));
            check_periodicity(model, integrator);
        }
        restart_settling(integrator);
    }
    integrator.end.seconds = until.seconds;
    integrator.end.time = until.time;
    integrator.control.changed = true;
}

}  // namespace gearbox
