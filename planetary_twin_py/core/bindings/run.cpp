// Windows of a run, for `planetary_twin_py.run.engine` and `planetary_twin_py.run.twin`.

#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include "bindings/arrays.hpp"
#include "bindings/interruptible.hpp"
#include "bindings/parts.hpp"
#include "bindings/raise.hpp"
#include "bindings/unlocked.hpp"
#include "bindings/vectors.hpp"
#include "model/tilting.hpp"
#include "run/figures.hpp"
#include "run/orbit.hpp"
#include "run/samples.hpp"
#include "run/statistics.hpp"
#include "run/window.hpp"
#include "run/windows.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

// Arrays of a waveform: time; those of `WAVEFORM`; displacement, bearing force, orbit and flank
// force, which have no columns if the axes are fixed; axial motion and tilts, if the axes tilt.
using WaveformTuple = std::tuple<Values, std::vector<Rows>, Rows, Rows, Rows, Rows, Rows>;

bool fits(const Rows& values, std::size_t rows, std::size_t columns) {
    return values.shape(0) == rows && values.shape(1) == columns;
}

Waveform waveform_of(const WaveformTuple& arrays, const Report& report, std::int64_t first,
                     double rate, const Train& train) {
    auto& [time, mesh, displacement, bearing_force, orbit, flank_force, tilting] = arrays;
    std::size_t rows = time.size(), meshes = static_cast<std::size_t>(report.meshes);
    bool sound = mesh.size() == WAVE_QUANTITIES;
    for (const Rows& values : mesh) sound &= fits(values, rows, meshes);
    if constexpr (MOVING) {
        auto bearings = static_cast<std::size_t>(train.moving.bearings);
        sound &= fits(displacement, rows, 2 * bearings) && fits(bearing_force, rows, 2 * bearings);
        sound &= fits(orbit, rows, 2 * MEMBERS) && fits(flank_force, rows, FLANKS * meshes);
        sound &= fits(tilting, rows, tilts(train) ? SAMPLE_TILTING * bearings : 0);
    }
    if (!sound) throw nb::value_error("waveform: arrays of a wrong shape");
    Waveform found{static_cast<std::int64_t>(rows), first, rate, time.data(), {}, {}};
    for (int k = 0; k < WAVE_QUANTITIES; ++k)
        found.mesh[k] = mesh[static_cast<std::size_t>(k)].data();
    found.axes = {displacement.data(), bearing_force.data(), orbit.data(), flank_force.data(),
                  tilting.data()};
    return found;
}

// Arguments of `run_window` in Python, in this order.
using JobTuple = std::tuple<const Model*, Integrator*, InstantTuple, SamplingTuple, const Limits*,
                            const Report*, std::int64_t, double, WaveformTuple, WindowEnd*, bool>;

WindowJob job_of(const JobTuple& values) {
    auto& [model, integrator, until, samples, limits, report, first, rate, waveform, end, closes] =
        values;
    return {*model,
            *integrator,
            instant_of(until),
            sampling_of(samples),
            *limits,
            *report,
            waveform_of(waveform, *report, first, rate, model->train),
            *end,
            closes};
}

int py_run_window(const Model& model, Integrator& integrator, const InstantTuple& until,
                  const SamplingTuple& samples, const Limits& limits, const Report& report,
                  std::int64_t first, double rate, const WaveformTuple& out, WindowEnd& end,
                  bool closes) {
    WindowJob job{model,
                  integrator,
                  instant_of(until),
                  sampling_of(samples),
                  limits,
                  report,
                  waveform_of(out, report, first, rate, model.train),
                  end,
                  closes};
    Interruptible unlocked;
    return static_cast<int>(run_window(job));
}

std::vector<int> py_run_windows(const std::vector<JobTuple>& tuples, int workers) {
    std::vector<WindowJob> jobs;
    jobs.reserve(tuples.size());
    for (const JobTuple& values : tuples) jobs.push_back(job_of(values));
    std::vector<Outcome> outcomes;
    {
        Interruptible unlocked;
        outcomes = run_windows(jobs, workers);
    }
    std::vector<int> codes;
    for (Outcome outcome : outcomes) codes.push_back(static_cast<int>(outcome));
    return codes;
}

void py_mesh_statistics(double time, const Table& integral, const Vector& dte_peak,
                        const Vector& force_peak, const Rows& out) {
    std::size_t meshes = integral.shape(1);
    if (integral.shape(0) != SUMS || out.shape(0) != STATISTICS || out.shape(1) != meshes ||
        meshes > MESHES)
        throw nb::value_error("mesh_statistics: arrays of a wrong shape");
    const double *dte = entries(dte_peak, meshes), *force = entries(force_peak, meshes);
    MeshSums sums{};
    sums.time = time;
    for (std::size_t i = 0; i < meshes; ++i) {
        for (std::size_t row = 0; row < SUMS; ++row)
            sums.integral[row][i] = integral.data()[row * meshes + i];
        sums.dte_peak[i] = dte[i];
        sums.force_peak[i] = force[i];
        mesh_statistics(sums, static_cast<std::int64_t>(i), out.data() + i,
                        static_cast<std::int64_t>(meshes));
    }
}

void bind_statistics(nb::module_& m) {
    nb::dict rows;
    for (int row = 0; row < STATISTICS; ++row) rows[MESH_STATISTICS[row].name] = row;
    m.attr("MESH_STATISTICS") = rows;
    m.def("mesh_statistics", &py_mesh_statistics, "time"_a, "integral"_a, "dte_peak"_a,
          "force_peak"_a, "out"_a,
          "Mean, rms and peak values of the meshes, from their sums over `time` seconds.");
}

}  // namespace

void bind_run(nb::module_& m) {
    nb::dict waveform;
    for (const WaveQuantity& each : WAVEFORM)
        waveform[each.name] = nb::make_tuple(each.first, each.last);
    m.attr("WAVEFORM") = waveform;
    m.attr("WITHIN_LIMITS") = static_cast<int>(Outcome::WITHIN_LIMITS);
    m.attr("EXCEEDED") = static_cast<int>(Outcome::EXCEEDED);
    m.attr("NOT_FINITE") = static_cast<int>(Outcome::NOT_FINITE);
    m.attr("NO_FINITE_STATE") = NO_FINITE_STATE;
    m.def(
        "run_window", &py_run_window, "model"_a, "integrator"_a, "until"_a, "samples"_a, "limits"_a,
        "report"_a, "first"_a, "rate"_a, "out"_a, "end"_a, "closes"_a,
        "Integrate to `until`; fill the waveform, and turns, angles, peaks and power of `end`.\n\n"
        "If the window closes there, `end` takes ledger and mesh sums. Returns the outcome.");
    m.def("run_windows", &py_run_windows, "jobs"_a, "workers"_a,
          "`run_window` of every job in `workers` threads; the outcomes in order.");
    m.def(
        "begin_window",
        [](const Model& model, Integrator& integrator, const InstantTuple& now, WindowEnd& end) {
            begin_window(model, integrator, instant_of(now), end);
        },
        "model"_a, "integrator"_a, "now"_a, "end"_a,
        "Begin a window: fill ledger, power and stored energy of `end`.");
    m.def(
        "pop_energy_ledger",
        [](Integrator& integrator, const InstantTuple& until, const Values& ledger) {
            pop_energy_ledger(integrator, instant_of(until), entries(ledger, LEDGER));
        },
        "integrator"_a, "until"_a, "ledger"_a,
        "Integrals of the ledger from the last call up to `until`, the end of the last window.");
    m.def(
        "pop_mesh_sums",
        [](const Model& model, Integrator& integrator, const InstantTuple& until, MeshSums& sums) {
            Unlocked unlocked;
            pop_mesh_sums(model, integrator, instant_of(until), sums);
        },
        "model"_a, "integrator"_a, "until"_a, "sums"_a,
        "Integrals and extremes of the meshes up to `until`, the end of the last window.");
    m.def(
        "orbits",
        [](const Table& displaced, const Vector& angle, const Rows& out) {
            std::size_t rows = angle.size(), columns = displaced.shape(1);
            if (displaced.shape(0) != rows || columns < 2 * MEMBERS ||
                !fits(out, rows, 2 * MEMBERS))
                throw nb::value_error("orbits: arrays of a wrong shape");
            for (std::size_t row = 0; row < rows; ++row) {
                const double* x = displaced.data() + row * columns;
                const double* const members[] = {x, x + 2, x + 4};
                turn_to_housing(angle.data()[row], members, out.data() + row * 2 * MEMBERS);
            }
        },
        "displaced"_a, "angle"_a, "out"_a,
        "Displacements of sun, ring and carrier in the housing, from those on the carrier.");
    m.def("window_figures", &window_figures, "train"_a, "report"_a, "begin"_a, "end"_a,
          "duration"_a, "out"_a, "Figures of a window of `duration` seconds.");
    bind_statistics(m);
}

}  // namespace gearbox
