#include "run/window.hpp"

#include <algorithm>

#include "integrators/integrator.hpp"
#include "integrators/methods.hpp"
#include "integrators/periodic.hpp"
#include "integrators/window_sums.hpp"
#include "mesh/add_sums.hpp"
#include "mesh/join_flanks.hpp"
#include "model/energy.hpp"
#include "run/samples.hpp"

namespace gearbox {

namespace {

// Part of the last step that lies after `now`.
double share_after(const Integrator& integrator, const Instant& now) {
    const State& end = integrator.end;
    const double step = delay(integrator.begin, {end.seconds, end.time});
    if (!(step > 0.0)) return 0.0;
    return std::clamp(delay(end, now) / -step, 0.0, 1.0);
}

// Copy entries `first` to `last` of the ledger at a time, of which the last step has `rest` after
// it.
void read_energy_ledger(const Integrator& integrator, double rest, int first, int last,
                        double* ledger) {
    const State &begin = integrator.begin, &end = integrator.end;
    for (int e = first; e < last; ++e)
        ledger[e] = end.energy[e] - rest * (end.energy[e] - begin.energy[e]);
}

// The same, and set them to zero: rounding errors of the sums of a long run would exceed the
// increments of a window.
void pop_energy_ledger(Integrator& integrator, double rest, int first, int last, double* ledger) {
    read_energy_ledger(integrator, rest, first, last, ledger);
    for (State* state : {&integrator.begin, &integrator.end, &integrator.periodic.start})
        for (int e = first; e < last; ++e) state->energy[e] -= ledger[e];
}

// End the last step at `now` by `end`, and count it up to there.
void end_step(Model& model, Integrator& integrator, const Instant& now, decltype(cut)& end) {
    count_until(model, integrator, delay(integrator.begin, now));
    const MeshSums total = integrator.sums.total;  // the last step is made again, not counted again
    end(model, integrator, now);
    integrator.sums.total = total;
    integrator.sums.taken = integrator.control.step;
}

// Whether a limit is exceeded. Throws NoFiniteState.
bool fill_waveforms(const WindowJob& job) {
    const Train& train = job.model.train;
    WindowEnd& end = job.end;
    end.peaks = {};
    std::vector<SampleRoom> rooms;
    std::vector<Grid> grids;
    for (const Waveform& out : job.out) {
        rooms.emplace_back(train, out, rooms.empty() ? &end.peaks : nullptr);
        grids.push_back({out.begin, rooms.back().samples()});
    }
    double shown[QUANTITIES * MESHES], speed[BODIES], drag[SAMPLE_DRAGS];
    Samples last{1,         QUANTITIES, train.meshes, train.bodies, AXES,      shown,
                 end.turns, end.angle,  speed,        drag,         &end.peaks};
    advance(job.model, job.integrator, job.until, NEVER, grids, last);
    for (std::size_t n = 0; n < rooms.size(); ++n) rooms[n].put(job.report, train, job.out[n]);
    std::copy_n(job.integrator.last.power, LEDGER, end.power);
    return exceeds(job.limits, train, job.model.operation, end.peaks, end.power);
}

}  // namespace

Outcome run_window(const WindowJob& job) {
    try {
        if (fill_waveforms(job)) return Outcome::EXCEEDED;
        if (!job.closes) return Outcome::WITHIN_LIMITS;
        begin_window(job.model, job.integrator, job.until, job.end);
        pop_mesh_sums(job.model, job.integrator, job.until, job.end.sums);
        return Outcome::WITHIN_LIMITS;
    } catch (const NoFiniteState&) {
        return Outcome::NOT_FINITE;
    }
}

void pop_mesh_sums(const Model& model, Integrator& integrator, const Instant& until,
                   MeshSums& sums) {
    count_until(model, integrator, delay(integrator.begin, until));
    sums = integrator.sums.total;
    if constexpr (MOVING) join_flanks(model.train, sums);
    integrator.sums.total = {};
}

void change_train(Model& model, Integrator& integrator, const Instant& now, const Train& train) {
    end_step(model, integrator, now, cut);
    const double before = elastic(model, integrator.end, integrator.scratch);
    model.train = train;
    integrator.end.energy[STIFFNESS_WORK] +=
        elastic(model, integrator.end, integrator.scratch) - before;
    integrator.control.changed = true;
}

bool warm_up(Model& model, Integrator& integrator, Network& network, const Instant& now,
             double duration) {
    double ledger[LEDGER];
    Periodic& periodic = integrator.periodic;
    pop_energy_ledger(integrator, share_after(integrator, now), HEAT, LEDGER, ledger);
    periodic.loss_at_start -= losses_of(ledger);
    advance_network(network, ledger + HEAT, duration);
    if (!has_moved(network)) return false;
    end_step(model, integrator, now, cut_for_oil);
    warm_oil(network, model.oil);
    integrator.control.changed = true;
    return true;
}

void begin_window(const Model& model, Integrator& integrator, const Instant& now, WindowEnd& end) {
    const double rest = share_after(integrator, now);
    pop_energy_ledger(integrator, rest, 0, HEAT, end.ledger);
    read_energy_ledger(integrator, rest, HEAT, LEDGER, end.ledger);
    std::copy_n(integrator.last.power, LEDGER, end.power);
    const Energies after = stored(model, integrator.end, integrator.scratch);
    end.kinetic = after.kinetic;
    end.elastic = after.elastic;
    if (rest == 0.0) return;
    const Energies before = stored(model, integrator.begin, integrator.scratch);
    end.kinetic -= rest * (after.kinetic - before.kinetic);
    end.elastic -= rest * (after.elastic - before.elastic);
}

void extend(const Train& train, const WindowEnd& next, WindowEnd& total) {
    const WindowEnd before = total;
    total = next;
    total.sums = before.sums;
    add_sums(next.sums, total.sums, mesh_lanes(train));
    for (int e = 0; e < LEDGER; ++e) total.ledger[e] += before.ledger[e];
}

}  // namespace gearbox
