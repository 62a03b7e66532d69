#include "run/window.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "integrators/integrator.hpp"
#include "integrators/methods.hpp"
#include "integrators/window_sums.hpp"
#include "mesh/join_flanks.hpp"
#include "model/energy.hpp"
#include "run/orbit.hpp"
#include "run/part_of_turn.hpp"
#include "run/samples.hpp"

namespace gearbox {

namespace {

constexpr Instant NEVER{0, std::numeric_limits<double>::infinity()};
// Number of rows of `observe` that a waveform needs.
constexpr std::int64_t WAVES = 1 + std::ranges::max(WAVEFORM, {}, &WaveQuantity::last).last;

// Reorder samples of the meshes of the train (rows, WAVES, meshes) as in the report.
void put_waveform(const Report& report, const Train& train, const double* mesh,
                  const Waveform& out) {
    const std::int64_t n = report.meshes, meshes = train.meshes;
    for (std::int64_t row = 0; row < out.rows; ++row) {
        const double* shown = mesh + row * WAVES * meshes;
        out.time[row] = static_cast<double>(out.first + row) / out.rate;
        for (std::int64_t i = 0; i < n; ++i)
            for (int k = 0; k < WAVE_QUANTITIES; ++k) {
                auto on = [&](std::int64_t flank) {
                    return wave_of(WAVEFORM[k],
                                   [&](int each) { return shown[each * meshes + flank]; });
                };
                double& value = out.mesh[k][row * n + i] = on(report.mesh[i]);
                if (MOVING && WAVEFORM[k].of_flank) value += on(other_flank(train, report.mesh[i]));
            }
    }
}

// Work space for samples of moving axes.
struct RoomOfAxes {
    std::vector<double> turns, angle, speed, moved, tilting;

    void ask(const Train& train, Samples& waves) {
        auto rows = static_cast<std::size_t>(waves.rows);
        auto bodies = static_cast<std::size_t>(train.bodies);
        turns.resize(rows * AXES);
        angle.resize(rows * bodies);
        speed.resize(rows * bodies);
        waves.bearings = train.moving.bearings;
        moved.resize(rows * static_cast<std::size_t>(waves.bearings) * SAMPLE_AXES);
        waves.turns = turns.data();
        waves.angle = angle.data();
        waves.speed = speed.data();
        waves.moved = moved.data();
        if (!tilts(train)) return;
        tilting.resize(rows * static_cast<std::size_t>(waves.bearings) * SAMPLE_TILTING);
        waves.tilting = tilting.data();
    }
};

// Angle of the carrier [rad], the last reported body.
double carrier_angle(const Report& report, const Train& train, const Samples& waves,
                     std::int64_t row) {
    const std::int64_t last = report.bodies - 1, j = report.body[last];
    double beside = j < train.bodies ? waves.angle[row * waves.bodies + j] : 0.0;
    return FULL_TURN * part_of_turn(report, last, waves.turns + row * waves.axes) + beside;
}

void put_axes(const Report& report, const Train& train, const Samples& waves,
              const AxesWaveform& out) {
    const std::int64_t bearings = waves.bearings, n = report.meshes;
    if (waves.tilting)
        std::copy_n(waves.tilting, waves.rows * bearings * SAMPLE_TILTING, out.tilting);
    for (std::int64_t row = 0; row < waves.rows; ++row) {
        const double* moved = waves.moved + row * bearings * SAMPLE_AXES;
        for (std::int64_t b = 0; b < bearings; ++b) {
            std::copy_n(moved + b * SAMPLE_AXES, 2, out.displacement + (row * bearings + b) * 2);
            std::copy_n(moved + b * SAMPLE_AXES + 2, 2,
                        out.bearing_force + (row * bearings + b) * 2);
        }
        const double* const members[] = {moved, moved + SAMPLE_AXES, moved + 2 * SAMPLE_AXES};
        turn_to_housing(carrier_angle(report, train, waves, row), members,
                        out.orbit + row * 2 * MEMBERS);
        const double* force = waves.mesh_row(row) + MESH_FORCE * train.meshes;
        for (std::int64_t i = 0; i < n; ++i) {
            const std::int64_t drive = report.mesh[i] % (train.meshes / 2);
            double* flank = out.flank_force + row * FLANKS * n + i;
            flank[0] = std::fabs(force[drive]);
            flank[n] = std::fabs(force[other_flank(train, drive)]);
        }
    }
}

// Part of the last step that lies after `now`.
double share_after(const Integrator& integrator, const Instant& now) {
    const State& end = integrator.end;
    const double step = delay(integrator.begin, {end.seconds, end.time});
    if (!(step > 0.0)) return 0.0;
    return std::clamp(delay(end, now) / -step, 0.0, 1.0);
}

// Whether a limit is exceeded. Throws NoFiniteState.
bool fill_waveform(const WindowJob& job) {
    const Train& train = job.model.train;
    WindowEnd& end = job.end;
    RoomOfAxes room;
    auto size = static_cast<std::size_t>(job.out.rows * WAVES * train.meshes);
    auto mesh = std::make_unique_for_overwrite<double[]>(size);
    end.peaks = {};
    Samples waves{job.out.rows, WAVES,   train.meshes, train.bodies, AXES,      mesh.get(),
                  nullptr,      nullptr, nullptr,      nullptr,      &end.peaks};
    double shown[QUANTITIES * MESHES], speed[BODIES], drag[SAMPLE_DRAGS];
    Samples last{1,         QUANTITIES, train.meshes, train.bodies, AXES,      shown,
                 end.turns, end.angle,  speed,        drag,         &end.peaks};
    if constexpr (MOVING) room.ask(train, waves);
    advance(job.model, job.integrator, job.until, NEVER, job.samples, waves, last);
    put_waveform(job.report, train, mesh.get(), job.out);
    if constexpr (MOVING) put_axes(job.report, train, waves, job.out.axes);
    std::copy_n(job.integrator.last.power, LEDGER, end.power);
    return exceeds(job.limits, train, job.model.operation, end.peaks, end.power);
}

}  // namespace

Outcome run_window(const WindowJob& job) {
    try {
        if (fill_waveform(job)) return Outcome::EXCEEDED;
        if (!job.closes) return Outcome::WITHIN_LIMITS;
        begin_window(job.model, job.integrator, job.until, job.end);
        pop_mesh_sums(job.model, job.integrator, job.until, job.end.sums);
        return Outcome::WITHIN_LIMITS;
    } catch (const NoFiniteState&) {
        return Outcome::NOT_FINITE;
    }
}

void pop_energy_ledger(Integrator& integrator, const Instant& until, double* ledger) {
    const double rest = share_after(integrator, until);
    const State &begin = integrator.begin, &end = integrator.end;
    for (int e = 0; e < LEDGER; ++e)
        ledger[e] = end.energy[e] - rest * (end.energy[e] - begin.energy[e]);
    for (State* state : {&integrator.begin, &integrator.end, &integrator.periodic.start})
        for (int e = 0; e < LEDGER; ++e) state->energy[e] -= ledger[e];
}

void pop_mesh_sums(const Model& model, Integrator& integrator, const Instant& until,
                   MeshSums& sums) {
    count_until(model, integrator, delay(integrator.begin, until));
    sums = integrator.sums.total;
    if constexpr (MOVING) join_flanks(model.train, sums);
    integrator.sums.total = {};
}

void begin_window(const Model& model, Integrator& integrator, const Instant& now, WindowEnd& end) {
    const double rest = share_after(integrator, now);
    pop_energy_ledger(integrator, now, end.ledger);
    std::copy_n(integrator.last.power, LEDGER, end.power);
    const Energies after = stored(model, integrator.end, integrator.scratch);
    end.kinetic = after.kinetic;
    end.elastic = after.elastic;
    if (rest == 0.0) return;
    const Energies before = stored(model, integrator.begin, integrator.scratch);
    end.kinetic -= rest * (after.kinetic - before.kinetic);
    end.elastic -= rest * (after.elastic - before.elastic);
}

}  // namespace gearbox
