// Windows of a run, for `planetary_twin_py.run.engine` and `planetary_twin_py.run.twin`.

#include <nanobind/stl/vector.h>

#include "bindings/arrays.hpp"
#include "bindings/interruptible.hpp"
#include "bindings/parts.hpp"
#include "bindings/raise.hpp"
#include "bindings/unlocked.hpp"
#include "bindings/waveforms.hpp"
#include "run/figures.hpp"
#include "run/statistics.hpp"
#include "run/window.hpp"
#include "run/windows.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

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

void bind_statistics(nb::module_& m) {
    nb::dict rows;
    for (int row = 0; row < STATISTICS; ++row) rows[MESH_STATISTICS[row].name] = row;
    m.attr("MESH_STATISTICS") = rows;
}

}  // namespace

void bind_run(nb::module_& m) {
    nb::list waveform;
    for (const WaveQuantity& each : WAVEFORM) waveform.append(each.name);
    m.attr("WAVEFORM") = nb::tuple(waveform);
    m.attr("PUBLISHED") = PUBLISHED;
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
        "pop_mesh_sums",
        [](const Model& model, Integrator& integrator, const InstantTuple& until, MeshSums& sums) {
            Unlocked unlocked;
            pop_mesh_sums(model, integrator, instant_of(until), sums);
        },
        "model"_a, "integrator"_a, "until"_a, "sums"_a,
        "Integrals and extremes of the meshes up to `until`, the end of the last window.");
    m.def("extend", &extend, "train"_a, "next"_a, "total"_a,
          "Extend `total`, the end of consecutive windows, by the next window.");
    m.def("window_figures", &window_figures, "train"_a, "report"_a, "begin"_a, "end"_a,
          "duration"_a, "out"_a, "Figures of a window of `duration` seconds.");
    bind_statistics(m);
}

}  // namespace gearbox
