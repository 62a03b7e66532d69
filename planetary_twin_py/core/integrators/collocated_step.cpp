#include "integrators/collocated_step.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "integrators/collocation.hpp"
#include "integrators/flanks.hpp"
#include "integrators/frame.hpp"
#include "integrators/methods.hpp"
#include "integrators/step_growth.hpp"
#include "integrators/step_ledger.hpp"
#include "integrators/work_of_machines.hpp"
#include "mesh/mesh_forces.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace {

constexpr double ON_EDGE = 1e-13;   // [s] tolerance of a step end at an edge of a pair
constexpr double WITHIN = 0.1;      // of the step: largest change of its end for that
constexpr double CUT_SHORT = 1e-3;  // of the next step
constexpr double STRETCH = 1.2;     // factor by which a step may be lengthened to end on an event
constexpr int MOST_CORRECTIONS = 3;
constexpr double REPEATED = 1e-3;  // relative change of times to events in repeated mesh cycles
constexpr double SHORTEN = 0.95, LENGTHEN = 1.3;  // factors by which a step is not changed there
constexpr double FORGET = 1.002;                  // factor per mesh cycle on a length that failed
constexpr double LONGEST = std::numeric_limits<double>::infinity();

// Whether Rosenbrock's method replaces collocation after a trial whose sweeps did not converge. The
// next trial would have h seconds; `unconverged` trials of this step have failed in this way. Where
// sweeps converge, collocation costs less, even if its error requires shorter steps.
bool rosenbrock_is_faster(const Control& control, double h, int unconverged) {
    return control.method != COLLOCATION && (unconverged > 1 || h < control.next_stiff);
}

// Whether the teeth are helical: then a contact moves by other than one base pitch per mesh cycle.
bool has_contact_lines(const Train& train) {
    for (std::int64_t p = 0; p < train.teeth.present[0][0]; ++p)
        if (train.teeth.travel[0][0][p] != 1.0) return true;
    return false;
}

// Free waves h seconds after the start, usually close to the last node.
template <int L>
void find_end_waves(Propagation& run, double h) {
    const std::int64_t last = run.nodes.count - 1;
    const double later = h - run.motion.step, phase = run.motion.fastest_rate * std::fabs(later);
    if (phase <= FURTHEST_SHIFT)
        shift_waves<L>(run.motion, later, terms_of_shift(phase), run.cosine[last], run.sine[last],
                       run.end_cosine, run.end_sine);
    else
        waves<L>(run.motion, h, run.end_cosine, run.end_sine);
}

// End the step after h seconds: x and v of the bodies only.
template <int L>
void place_end(const Model& model, Integrator& integrator, double h) {
    Propagation& run = integrator.run;
    const std::int64_t last = run.nodes.count - 1;
    integrator.control.step = h;
    if (h == run.motion.step) {
        copy<L>(run.cosine[last], run.end_cosine);
        copy<L>(run.sine[last], run.end_sine);
        copy<L>(run.node[last].x, integrator.end.x);
        copy<L>(run.node[last].v, integrator.end.v);
        return;
    }
    find_end_waves<L>(run, h);
    RowPair<L> modes = modal_states<L>(run.motion, h * run.motion.per_step, Row<L>(run.end_cosine),
                                       Row<L>(run.end_sine));
    auto [x, v] = sum_rows<L>(contacts_of(run).matrices.shapes(), modes);
    x.store(integrator.end.x);
    v.store(integrator.end.v);
    move_given(model, integrator.begin, h, integrator.end.x, integrator.end.v);
}

// Fill the rest of the state at the end of the step: trim, energy ledger and clock.
template <int L>
void finish_end(const Model& model, Integrator& integrator) {
    const double h = integrator.control.step;
    trim_at(model, integrator, h, integrator.end.x, integrator.end.trim);
    integrate_powers<L>(model.train, integrator, h);
    add_work_of_machines<L>(model, integrator, h);
    advance_clock(model, integrator, h);
}

// Time [s] until a mesh reaches the edge of its segment, and the part due to the change of its
// cycle rate.
struct TimeToEdge {
    double gap, bent;
};

// The cycle rate is taken to change as between the last two nodes.
TimeToEdge time_by_pace(const Model& model, const Integrator& integrator, std::int64_t mesh) {
    const Train& train = model.train;
    const Propagation& run = integrator.run;
    const std::int64_t last = run.nodes.count - 1;
    double gap = time_to_edge(model, integrator, mesh);
    if (last == 0) return {gap, gap};
    double cycle_rate = integrator.constants.cycle_rate + cycle_shift(train, integrator.end.v);
    double faster = cycle_shift(train, run.node[last].v) - cycle_shift(train, run.node[last - 1].v);
    double between = (run.nodes.abscissa[last] - run.nodes.abscissa[last - 1]) * run.motion.step;
    double bent = -0.5 * gap * gap * faster / (between * cycle_rate);
    return {gap + bent, bent};
}

// Move the end of the step to the instant at which `mesh` reaches the edge of its segment. If the
// cycle rate has changed too much for that, a later step ends on the edge.
template <int L>
void end_step_at_edge(const Model& model, Integrator& integrator, std::int64_t mesh, double h) {
    for (int k = 0; k < MOST_CORRECTIONS; ++k) {
        auto [gap, bent] = time_by_pace(model, integrator, mesh);
        if (std::fabs(gap) < ON_EDGE || !(std::fabs(gap) < WITHIN * h)) return;
        h += gap;
        place_end<L>(model, integrator, h);
        if (std::fabs(bent) < ON_EDGE) return;  // what is left is smaller still
    }
}

// End the step at the first change of contact of a mesh; return that mesh, or NO_MESH.
template <int L>
std::int64_t end_on_flank_event(const Model& model, Integrator& integrator, double h) {
    FlankEvent event = first_flank_event(model, integrator);
    if (event.mesh != NO_MESH && h > SHORTEST_STEP && !at_event(model, integrator, event.mesh))
        place_end<L>(model, integrator, event.when);
    return event.mesh;
}

// Whether the step starts as long before an event as the step with this number in the last mesh
// cycle.
bool repeats(Propagation& run, double event) {
    const StoredIncrement* past = stored_increment(run);
    return past && past->step > 0.0 && std::fabs(past->event - event) < REPEATED * event;
}

// First trial: what was planned for this step in the last mesh cycle, or the step that follows from
// the last one. Shorter ones than those that are resolved are not tried.
template <int L>
double first_trial(Integrator& integrator, std::int64_t bodies, double longest, double event) {
    const StoredIncrement* past = stored_increment(integrator.run);
    const bool first = integrator.control.changed && past->step > 0.0;
    const bool planned_before = first || repeats(integrator.run, event);
    double h = planned_before ? past->next : integrator.control.next_step;
    h = shortest_resolved<L>(integrator.run, bodies, h);
    return std::min(planned(event, std::min(h, longest), STRETCH), longest);
}

// Choose the first trial for the step with this number and these contacts in the next mesh cycle,
// after one of h; `next` is that of the next step, `refused` the shortest length that failed.
//
// Equal steps in every mesh cycle need few sweeps, so a length is not changed by little. Halfway to
// a length that failed, it approaches the longest that does not fail.
void plan_next_cycle(Propagation& run, double h, double next, double refused, double event) {
    StoredIncrement* const plan = stored_increment(run);
    if (plan == nullptr) return;
    const bool again = repeats(run, event);
    plan->event = event;
    plan->refused = again ? std::min(FORGET * plan->refused, refused) : refused;
    plan->next = next;
    if (!again || h == event) return;
    if (plan->refused > h) plan->next = std::min(plan->next, 0.5 * (h + plan->refused));
    if (plan->next >= SHORTEN * h && plan->next <= LENGTHEN * h) plan->next = h;
}

// Length of an accepted step, 0 if there is none, with its error in tolerances; then also the
// number of steps for which Rosenbrock's method is used.
struct Accepted {
    double step;
    double error;
    std::int64_t fallback_steps = 0;
    double refused = LONGEST;  // shortest length that failed [s]
};

template <int L>
Accepted accepted_step(const Model& model, Integrator& integrator, double first, bool fresh) {
    Control& control = integrator.control;
    double h = first;
    const double order = static_cast<double>(integrator.run.nodes.count);
    int unconverged = 0;
    double refused = LONGEST;
    while (true) {
        if (control.method != COLLOCATION && !resolves<L>(integrator.run, h))
            return {0.0, 0.0, h < first ? FALLBACK_STEPS : BRIEF_FALLBACK_STEPS};
        Outcome tried = collocate<L>(model, integrator, h, fresh);
        if (tried.error <= 1.0 || (h <= SHORTEST_STEP && tried.error < DIVERGED))
            return {h, tried.error, 0, refused};
        unconverged += tried.converged ? 0 : 1;
        double shorter = h * std::max(SHRINK, growth_of_step(tried.error, order));
        if (h <= SHORTEST_STEP ||
            (!tried.converged && rosenbrock_is_faster(control, shorter, unconverged)))
            return {0.0, 0.0, FALLBACK_STEPS};
        ++control.rejected;
        refused = h;
        h = std::max(shorter, SHORTEST_STEP);
    }
}

// Store powers and friction at the last node, which the next step uses at its start. The modes have
// unit mass, so the forces on the bodies follow from those in the modes.
template <int L>
void store_last_forces(const Train& train, const Propagation& run, Evaluation& last) {
    const Node& node = run.node[run.nodes.count - 1];
    (Row<L>(train.body.mass) *
     sum_rows<L>(contacts_of(run).matrices.shapes(), Row<L>(node.friction_force)))
        .store(last.friction_force);
    std::memcpy(last.power, node.power, sizeof last.power);
    using OfMeshes = Row<MESH_LANES<L>>;
    last.power[DAMPING] += sum_of_meshes(train, OfMeshes(node.meshes.damping_power));
    last.power[STIFFNESS_WORK] += sum_of_meshes(train, OfMeshes(node.meshes.stiffness_power));
    last.power[FRICTION] =
        train.friction ? sum_of_meshes(train, OfMeshes(node.friction.drag.power)) : 0.0;
}

template <int L>
std::int64_t make_step(const Model& model, Integrator& integrator, double longest,
                       const NextEvent& event) {
    Control& control = integrator.control;
    Propagation& run = integrator.run;
    enter<L>(model, integrator);
    const bool fresh = control.changed;
    run.steps_in_contact_state = fresh ? 0 : run.steps_in_contact_state + 1;
    double first = first_trial<L>(integrator, model.train.bodies, longest, event.time);
    auto [h, error, fallback_steps, refused] = accepted_step<L>(model, integrator, first, fresh);
    if (h == 0.0) {
        control.fallback_steps = fallback_steps;
        return FAILED;
    }
    double factor = growth_of_step(error, static_cast<double>(run.nodes.count));
    // A step between close edges of helical teeth does not predict the length of later steps.
    const bool cut_short =
        has_contact_lines(model.train) && h == event.time && h < CUT_SHORT * control.next_step;
    if (!cut_short) control.next_step = h * std::min(GROW, std::max(SHRINK, factor));
    plan_next_cycle(run, h, control.next_step, refused, event.time);
    store_increment<L>(model, integrator);
    store_step<L>(run);
    control.collocated = true;
    control.changed = false;
    copy_without_bristles(integrator.begin, integrator.end);
    place_end<L>(model, integrator, h);
    if (event.mesh != NO_MESH && h == event.time)
        end_step_at_edge<L>(model, integrator, event.mesh, h);
    store_last_forces<L>(model.train, run, integrator.last);
    std::int64_t changing = end_on_flank_event<L>(model, integrator, h);
    finish_end<L>(model, integrator);
    run.past.end_seconds = integrator.end.seconds;
    run.past.end_time = integrator.end.time;
    return changing;
}

}  // namespace

void end_within(const Model& model, Integrator& integrator, double h) {
    copy_without_bristles(integrator.begin, integrator.end);
    with_lanes(model.train, [&](auto lanes) {
        place_end<lanes>(model, integrator, h);
        finish_end<lanes>(model, integrator);
    });
}

std::int64_t collocated_step(const Model& model, Integrator& integrator, double longest,
                             const NextEvent& event) {
    return with_lanes(model.train, [&](auto lanes) {
        return make_step<lanes>(model, integrator, longest, event);
    });
}

}  // namespace gearbox
