#include "integrators/collocated_step.hpp"

#include <cmath>
#include <cstring>

#include "integrators/collocation.hpp"
#include "integrators/flanks.hpp"
#include "integrators/frame.hpp"
#include "integrators/step_control.hpp"
#include "integrators/step_ledger.hpp"
#include "mesh/deflection.hpp"
#include "mesh/mesh_forces.hpp"
#include "train/equations.hpp"

namespace gearbox {

namespace {

constexpr double ON_EDGE = 1e-13;  // [s] to which a step ends on the edge of a tooth pair
constexpr double WITHIN = 0.1;     // of the step, by which its end is moved for that at most
constexpr double STRETCH = 1.2;    // by which a planned step is stretched to end on an event
constexpr double OUTDONE = 0.2;    // of the other method's step, below which it is taken
constexpr int LANDINGS = 3;

// Whether Rosenbrock's method is to be taken rather than collocation over h seconds.
bool outdone(const Control& control, double h, bool settled, int restless) {
    if (control.method == COLLOCATION) return false;
    if (!settled && (restless > 1 || h < control.next_stiff)) return true;
    return h < (control.slow ? 1.0 : OUTDONE) * control.next_stiff;
}

// Free waves h seconds after the start, most often just beside the last node.
template <int L>
void find_end_waves(Propagation& run, double h) {
    const std::int64_t last = run.nodes.count - 1;
    const double later = h - run.motion.step;
    if (phase_within<L>(run, later) <= FEW_SHIFTED)
        shift_waves<L, FEW_TERMS>(run.motion, later, run.cosine[last], run.sine[last],
                                  run.end_cosine, run.end_sine);
    else
        waves<L>(run.motion, h, run.end_cosine, run.end_sine);
}

// Let the step end after h seconds: bodies alone.
template <int L>
void place_end(March& march, double h) {
    Propagation& run = march.run;
    const std::int64_t last = run.nodes.count - 1;
    march.control.step = h;
    if (h == run.motion.step) {
        copy<L>(run.cosine[last], run.end_cosine);
        copy<L>(run.sine[last], run.end_sine);
        copy<L>(run.node_x[last], march.end.x);
        copy<L>(run.node_v[last], march.end.v);
        return;
    }
    find_end_waves<L>(run, h);
    modal_states<L>(run.motion, h / run.motion.step, run.end_cosine, run.end_sine, run.now_q,
                    run.now_p);
    const ContactState& contacts = contacts_of(run);
    sum_rows_twice<L>(contacts.form, run.now_q, run.now_p, march.end.x, march.end.v);
}

// What else the end of the step has, once it stands.
template <int L>
void finish_end(const Model& model, March& march) {
    const double h = march.control.step;
    trim_at(model, march, h, march.end.x, march.end.trim);
    integrate_powers<L>(march, h);
    pass_time(model, march, h);
}

// Time [s] until `mesh` comes to the edge of its segment, were the pace to change on as it did
// between the last two nodes.
double time_by_pace(const Model& model, const March& march, std::int64_t mesh) {
    const Train& train = model.train;
    const Propagation& run = march.run;
    const std::int64_t last = run.nodes.count - 1;
    double gap = time_to_edge(model, march, mesh);
    if (last == 0) return gap;
    double pace = march.moment.cycle_rate + cycle_shift(train, march.end.v);
    double faster = cycle_shift(train, run.node_v[last]) - cycle_shift(train, run.node_v[last - 1]);
    double between = (run.nodes.abscissa[last] - run.nodes.abscissa[last - 1]) * run.motion.step;
    return gap - 0.5 * gap * gap * faster / (between * pace);
}

// Move the end of the step to where `mesh` comes to the edge of its segment. Where the pace has
// changed too much for that, the next steps come to the edge.
template <int L>
void meet_edge(const Model& model, March& march, std::int64_t mesh, double h) {
    for (int k = 0; k < LANDINGS; ++k) {
        double gap = time_by_pace(model, march, mesh);
        if (std::fabs(gap) < ON_EDGE || !(std::fabs(gap) < WITHIN * h)) return;
        h += gap;
        place_end<L>(march, h);
    }
}

// Let the step end where a mesh changes its contact first; that mesh, or NO_MESH.
template <int L>
std::int64_t end_on_flank_event(const Model& model, March& march, double h) {
    FlankEvent event = first_flank_event(model, march);
    if (event.mesh != NO_MESH && h > SHORTEST_STEP && !at_event(model, march, event.mesh))
        place_end<L>(march, event.when);
    return event.mesh;
}

// The step that did when such contacts began the last time, or that follows from the last step.
double first_trial(March& march, double longest, double event) {
    const ContactState& contacts = contacts_of(march.run);
    bool known = march.control.changed && contacts.step > 0.0;
    double h = known ? contacts.step : march.control.next_step;
    return std::min(planned(event, std::min(h, longest), STRETCH), longest);
}

// Length of a step whose error is allowed, and by how much the next may be longer; 0: none.
struct Accepted {
    double step;
    double error;
};

template <int L>
Accepted accepted_step(const Model& model, March& march, double h, bool fresh) {
    Control& control = march.control;
    const double order = static_cast<double>(march.run.nodes.count);
    int restless = 0;
    while (true) {
        if (control.method != COLLOCATION && !resolves(march.run, model.train.bodies, h))
            return {0.0, 0.0};
        Outcome tried = collocate<L>(model, march, h, fresh);
        if (tried.error <= 1.0 || (h <= SHORTEST_STEP && tried.error < ASTRAY))
            return {h, tried.error};
        restless += tried.settled ? 0 : 1;
        double shorter = h * std::max(SHRINK, SAFETY * std::pow(tried.error, -1.0 / order));
        if (h <= SHORTEST_STEP || outdone(control, shorter, tried.settled, restless))
            return {0.0, 0.0};
        ++control.rejected;
        h = std::max(shorter, SHORTEST_STEP);
    }
}

template <int L>
std::int64_t make_step(const Model& model, March& march, double longest, const NextEvent& event) {
    Control& control = march.control;
    Propagation& run = march.run;
    const std::int64_t last = run.nodes.count - 1;
    hold_friction(model, march);
    enter<L>(model, march);
    const bool fresh = control.changed;
    double first = first_trial(march, longest, event.time);
    auto [h, error] = accepted_step<L>(model, march, first, fresh);
    if (h == 0.0) return FAILED;
    double exponent = -1.0 / static_cast<double>(run.nodes.count);
    double factor = error > 0.0 ? SAFETY * std::pow(error, exponent) : GROW;
    control.next_step = h * std::min(GROW, std::max(SHRINK, factor));
    if (fresh) {
        contacts_of(run).step = control.next_step;
        remember<L>(march);
    }
    if (h < std::min(event.time, longest) && outdone(control, h, true, 0)) control.detour = DETOUR;
    control.collocated = true;
    control.changed = false;
    march.end = march.begin;
    place_end<L>(march, h);
    if (event.mesh != NO_MESH && h == event.time) meet_edge<L>(model, march, event.mesh, h);
    std::memcpy(march.last.power, run.evaluation[last].power, sizeof march.last.power);
    std::memcpy(march.last.rubbing, run.evaluation[last].rubbing, sizeof march.last.rubbing);
    std::int64_t changing = end_on_flank_event<L>(model, march, h);
    finish_end<L>(model, march);
    return changing;
}

}  // namespace

void hold_friction(const Model& model, March& march) {
    const State& begin = march.begin;
    const StepConstants& constants = march.moment;
    Evaluation& first = march.first;
    move_meshes(model.train, begin.x, begin.v, first.now);
    mesh_forces(model, begin, constants, begin.x, begin.v, 0.0, first);
    std::memcpy(first.rubbing, march.last.rubbing, sizeof first.rubbing);
    assemble_forces(model, begin, constants, begin.x, begin.v, 0.0, begin.trim, first);
}

void end_within(const Model& model, March& march, double h) {
    march.end = march.begin;
    with_lanes(model.train, [&](auto lanes) {
        place_end<lanes>(march, h);
        finish_end<lanes>(model, march);
    });
}

std::int64_t collocated_step(const Model& model, March& march, double longest,
                             const NextEvent& event) {
    return with_lanes(model.train,
                      [&](auto lanes) { return make_step<lanes>(model, march, longest, event); });
}

}  // namespace gearbox
