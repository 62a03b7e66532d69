// Windows of a run, for `planetary_twin_py.run.engine` and `planetary_twin_py.run.twin`.

#include <nanobind/stl/vector.h>

#include "bindings/arrays.hpp"
#include "bindings/interruptible.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "bindings/unlocked.hpp"
#include "bindings/waveforms.hpp"
#include "run/figures.hpp"
#include "run/statistics.hpp"
#include "run/window.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

// planetary_twin_py's WindowJob.
using JobTuple = std::tuple<const Model*, Integrator*, InstantTuple, const Limits*, const Report*,
                            std::vector<GridTuple>, WindowEnd*, bool>;

WindowJob job_of(const JobTuple& values) {
    auto& [model, integrator, until, limits, report, grids, end, closes] = values;
    std::vector<Waveform> out;
    for (const GridTuple& each : grids) out.push_back(waveform_of(each, *report, model->train));
    return {*model, *integrator, instant_of(until), *limits, *report, out, *end, closes};
}

int py_run_window(const JobTuple& values) {
    const WindowJob job = job_of(values);
    Interruptible unlocked;
    return static_cast<int>(run_window(job));
}

std::vector<int> py_run_windows(const std::vector<JobTuple>& tuples, int workers) {
    std::vector<WindowJob> jobs;
    jobs.reserve(tuples.size());
    for (const JobTuple& values : tuples) jobs.push_back(job_of(values));
    Interruptible unlocked;
    std::vector<int> codes;
    for (Outcome outcome : run_windows(jobs, workers)) codes.push_back(static_cast<int>(outcome));
    return codes;
}

}  // namespace

void bind_run(nb::module_& m) {
    nb::dict statistics;
    for (int row = 0; row < STATISTICS; ++row) statistics[MESH_STATISTICS[row].name] = row;
    m.attr("MESH_STATISTICS") = statistics;
    nb::list waveform;
    for (const WaveQuantity& each : WAVEFORM) waveform.append(each.name);
    m.attr("WAVEFORM") = nb::tuple(waveform);
    CONSTANTS(m, PUBLISHED, NO_FINITE_STATE);
    m.attr("WITHIN_LIMITS") = static_cast<int>(Outcome::WITHIN_LIMITS);
    m.attr("EXCEEDED") = static_cast<int>(Outcome::EXCEEDED);
    m.attr("NOT_FINITE") = static_cast<int>(Outcome::NOT_FINITE);
    m.def(
        "run_window", &py_run_window, "job"_a,
        "Integrate to `until`; fill the waveforms, and turns, angles, peaks and power of `end`.\n\n"
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
    m.def(
        "change_train",
        [](Model& model, Integrator& integrator, const InstantTuple& now, const Train& train) {
            run_unlocked([&] { change_train(model, integrator, instant_of(now), train); });
        },
        "model"_a, "integrator"_a, "now"_a, "train"_a,
        "Continue with another train from `now` on; what springs gain is work of stiffness.\n\n"
        "Raises:\n    ArithmeticError: no finite state can be reached.");
    m.def("extend", &extend, "train"_a, "next"_a, "total"_a,
          "Extend `total`, the end of consecutive windows, by the next window.");
    m.def("window_figures", &window_figures, "train"_a, "report"_a, "begin"_a, "end"_a,
          "duration"_a, "out"_a, "Figures of a window of `duration` seconds.");
}

}  // namespace gearbox
