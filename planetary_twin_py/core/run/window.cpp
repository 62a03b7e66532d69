#include "run/window.hpp"

#include <algorithm>
#include <limits>
#include <memory>

#include "integrators/march.hpp"
#include "integrators/step_control.hpp"
#include "integrators/window_sums.hpp"
#include "mesh/join_flanks.hpp"
#include "run/samples.hpp"
#include "train/energy.hpp"

namespace gearbox {

namespace {

constexpr Instant NEVER{0, std::numeric_limits<double>::infinity()};
constexpr std::int64_t WAVES = VISCOUS + 1;  // quantities of `observe` that a waveform shows

// Put samples of the meshes of the train (rows, WAVES, meshes) into the order of the report.
void put_waveform(const Report& report, const Train& train, const double* mesh,
                  const Waveform& out) {
    const std::int64_t n = report.meshes, meshes = train.meshes;
    for (std::int64_t row = 0; row < out.rows; ++row) {
        const double* shown = mesh + row * WAVES * meshes;
        out.time[row] = static_cast<double>(out.first + row) / out.rate;
        for (std::int64_t i = 0; i < n; ++i) {
            const double* at = shown + report.mesh[i];
            out.dte[row * n + i] = at[DTE * meshes];
            out.mesh_force[row * n + i] = at[MESH_FORCE * meshes];
            out.friction[row * n + i] = at[BOUNDARY * meshes] + at[VISCOUS * meshes];
            if constexpr (!MOVING) continue;
            const double* other = shown + other_flank(train, report.mesh[i]);
            out.mesh_force[row * n + i] += other[MESH_FORCE * meshes];
            out.friction[row * n + i] += other[BOUNDARY * meshes] + other[VISCOUS * meshes];
        }
    }
}

// Whether a limit is exceeded. Throws NoFiniteState.
bool fill_waveform(const WindowJob& job) {
    const Train& train = job.model.train;
    WindowEnd& end = job.end;
    auto size = static_cast<std::size_t>(job.out.rows * WAVES * train.meshes);
    auto mesh = std::make_unique_for_overwrite<double[]>(size);
    end.peaks = {};
    Samples waves{job.out.rows, WAVES,   train.meshes, train.bodies, AXES,      mesh.get(),
                  nullptr,      nullptr, nullptr,      nullptr,      &end.peaks};
    double shown[QUANTITIES * MESHES], speed[BODIES], drag[SAMPLE_DRAGS];
    Samples last{1,         QUANTITIES, train.meshes, train.bodies, AXES,      shown,
                 end.turns, end.angle,  speed,        drag,         &end.peaks};
    advance(job.model, job.march, job.until, NEVER, job.samples, waves, last);
    put_waveform(job.report, train, mesh.get(), job.out);
    std::copy_n(job.march.last.power, LEDGER, end.power);
    return exceeds(job.limits, train, job.model.load, end.peaks, end.power);
}

}  // namespace

Outcome run_window(const WindowJob& job) {
    try {
        if (fill_waveform(job)) return Outcome::EXCEEDED;
        if (!job.closes) return Outcome::WITHIN_LIMITS;
        take_books(job.model, job.march, job.end);
        take_mesh_sums(job.model, job.march, job.until, job.end.sums);
        return Outcome::WITHIN_LIMITS;
    } catch (const NoFiniteState&) {
        return Outcome::NOT_FINITE;
    }
}

void take_ledger(March& march, double* ledger) {
    std::copy_n(march.end.energy, LEDGER, ledger);
    for (State* state : {&march.begin, &march.end, &march.periodic.start})
        for (int e = 0; e < LEDGER; ++e) state->energy[e] -= ledger[e];
}

void take_mesh_sums(const Model& model, March& march, const Instant& until, MeshSums& sums) {
    count_until(model, march, delay(march.begin, until));
    sums = march.sums.total;
    if constexpr (MOVING) join_flanks(model.train, sums);
    march.sums.total = {};
}

void take_books(const Model& model, March& march, WindowEnd& end) {
    end.seconds = march.end.seconds;
    end.time = march.end.time;
    end.time_rest = 0.0;
    take_ledger(march, end.ledger);
    std::copy_n(march.last.power, LEDGER, end.power);
    auto [kinetic, elastic] = stored(model, march.end, march.scratch);
    end.kinetic = kinetic;
    end.elastic = elastic;
}

}  // namespace gearbox
