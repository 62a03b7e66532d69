#include "integrators/march.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/collocated_step.hpp"
#include "integrators/creep.hpp"
#include "integrators/cycle_samples.hpp"
#include "integrators/edges.hpp"
#include "integrators/frame.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/periodic.hpp"
#include "integrators/step_control.hpp"
#include "integrators/step_sums.hpp"
#include "integrators/stiff_step.hpp"
#include "integrators/window_sums.hpp"
#include "mesh/both_flanks.hpp"
#include "mesh/contact_change.hpp"
#include "train/set_step_constants.hpp"
#include "tribology/tooth_friction.hpp"

namespace gearbox {

namespace {

// Errors of speeds, over the layer in which friction reverses, in tolerances: where pairs slide,
// and where they hold and the gears may stick and slip.
constexpr double SLIDING_SHARE = 60.0, CREEPING_SHARE = 1.0;
constexpr double AT_TARGET =
    1e-12;  // [s] of the slew rate, by which a set-point may miss its target

// Allow errors in proportion to what the meshes yield, be it to torques or to inertia.
//
// Friction turns round within a narrow layer of sliding speeds: where the gears turn slowly, this
// is what an error of a speed is measured by.
void set_tolerances(const Model& model, March& march) {
    const Train& train = model.train;
    Control& control = march.control;
    double deflection = control.deflection;
    for (std::int64_t a = 0; a < train.axes; ++a)
        deflection += control.yielding[a] * std::fabs(march.constants.slew[a]);
    control.tolerance_x = control.tolerance * deflection;
    control.tolerance_v = control.tolerance_x * control.quickness;
    if (!train.friction) return;
    double share = control.creeping ? CREEPING_SHARE : SLIDING_SHARE;
    double layer = friction_layer(train, model.oil, march.constants.cycle_rate);
    double allowed = share * control.tolerance * layer;
    control.slow = allowed < control.tolerance_v;
    control.tolerance_v = std::min(control.tolerance_v, allowed);
}

// Let set-points that have reached their targets stay there.
void end_slews(const Model& model, March& march) {
    for (std::int64_t a = 0; a < model.train.axes; ++a) {
        double gap = model.load.target_speed[a] - march.end.set_speed[a];
        double slew = march.constants.slew[a];
        if (gap * slew <= 0.0 || std::fabs(gap) < AT_TARGET * model.load.slew_rate) {
            march.end.set_speed[a] = model.load.target_speed[a];
            march.control.changed |= slew != 0.0;
        }
    }
}

// Write the samples that are due up to the end of the last step.
void write_due_samples(const Model& model, March& march, Sampling& samples, const Samples& out,
                       std::int64_t& taken) {
    const std::int64_t room = out.rows;
    double delays[MOST_INSTANTS];
    while (taken < room && delay(march.end, due(samples)) <= 0.0) {
        if (march.periodic.playing) {
            sample_cycle(model, march, due(samples), out, taken++);
            samples = after(samples);
            continue;
        }
        int count = 0;
        while (count < MOST_INSTANTS && taken + count < room &&
               delay(march.end, due(samples)) <= 0.0) {
            delays[count++] = delay(march.begin, due(samples));
            samples = after(samples);
        }
        sample(model, march, delays, count, out, taken);
        taken += count;
    }
}

}  // namespace

void begin_step(const Model& model, March& march) {
    march.begin = march.end;
    rebase(model.train, march.begin);
    set_step_constants(model, march.begin, march.constants);
    hold_or_slide(model, march);
    set_tolerances(model, march);
    avoid_reversals(model, march);
    if (both_flanks_touch(model, march.begin, march.constants)) ++march.control.both_flanks;
}

void one_step(const Model& model, March& march, double longest) {
    Control& control = march.control;
    march.sums.stale = control.changed || control.collocated || !march.sums.known;
    NextEvent event = next_event(model, march);
    longest = std::min(longest, control.longest);
    std::int64_t changing = FAILED;
    bool asked = control.method == AUTO || control.method == COLLOCATION;
    bool collocates = asked && !control.creeping;
    if (collocates && (control.detour == 0 || control.method == COLLOCATION)) {
        changing = collocated_step(model, march, longest, event);
        if (changing == FAILED) control.changed = true;
    }
    if (changing == FAILED) changing = stiff_step(model, march, longest, event.time);
    accept(model, march, changing);
}

void accept(const Model& model, March& march, std::int64_t mesh) {
    march.sums.known = !march.sums.unasked;
    if (march.sums.known) sum_step(model, march);
    if (mesh != NO_MESH) {
        change_contact(model, march.end, march.scratch, mesh);
        march.control.flank_events += static_cast<std::int64_t>(model.train.copies[mesh]);
        march.control.changed = true;
    }
    pass_edges(model, march);
    end_slews(model, march);
    ++march.control.steps;
}

void advance(const Model& model, March& march, const Instant& until, const Instant& bound,
             Sampling samples, const Samples& out) {
    std::int64_t taken = 0;
    while (true) {
        write_due_samples(model, march, samples, out, taken);
        if (taken == out.rows && delay(march.end, until) <= 0.0) return;
        count_step(model, march);
        if (march.periodic.playing) {
            play_window(model, march, until, samples, out, taken);
        } else {
            begin_step(model, march);
            one_step(model, march, delay(march.begin, bound));
            watch(model, march);
        }
    }
}

void advance(const Model& model, March& march, const Instant& until, const Instant& bound,
             const Sampling& samples, const Samples& out, const Samples& last) {
    advance(model, march, until, bound, samples, out);
    if (march.periodic.playing)
        sample_cycle(model, march, until, last, 0);
    else
        sample(model, march, delay(march.begin, until), last, 0);
}

void interrupt(const Model& model, March& march, const Instant& until) {
    if (!march.control.collocated || march.periodic.playing) return cut(model, march, until);
    restart_settling(march);
    if (delay(march.end, until) < 0.0) {
        end_within(model, march, delay(march.begin, until));
        march.control.changed = false;
    }
    march.end.seconds = until.seconds;
    march.end.time = until.time;
    march.run.place = KEPT_STEPS;  // what is kept of a contact state begins where it begins
}

void cut(const Model& model, March& march, const Instant& until) {
    restart_settling(march);
    if (delay(march.end, until) < 0.0) {
        march.end = march.begin;
        march.control.changed = true;
        Instant close{until.seconds, until.time - SHORTEST_STEP};
        while (delay(march.end, close) > 0.0) {
            count_step(model, march);
            begin_step(model, march);
            one_step(model, march, delay(march.begin, until));
            watch(model, march);
        }
        restart_settling(march);
    }
    march.end.seconds = until.seconds;
    march.end.time = until.time;
    march.control.changed = true;
}

}  // namespace gearbox
