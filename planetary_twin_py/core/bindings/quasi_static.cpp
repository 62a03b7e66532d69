// Quasi-static running, for `planetary_twin_py.quasi_static`.

#include <nanobind/stl/pair.h>

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "bindings/unlocked.hpp"
#include "bindings/waveforms.hpp"
#include "mesh/join_flanks.hpp"
#include "model/passages.hpp"
#include "model/weight.hpp"
#include "quasi_static/equilibrium.hpp"
#include "quasi_static/follow.hpp"
#include "quasi_static/motion.hpp"
#include "quasi_static/planet_load.hpp"
#include "quasi_static/quadrature.hpp"
#include "quasi_static/sampling.hpp"
#include "quasi_static/second_coupling.hpp"
#include "quasi_static/totals.hpp"
#include "run/window.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

using Shown = double[QUANTITIES][MESHES];

// (QUANTITIES, meshes), without unused entries.
auto shown_array(const Shown& shown, std::int64_t meshes) {
    double packed[QUANTITIES * MESHES];
    for (int q = 0; q < QUANTITIES; ++q)
        std::copy(shown[q], shown[q] + meshes, packed + q * meshes);
    return new_array(packed, {std::size_t(QUANTITIES), std::size_t(meshes)});
}

auto py_solve_equilibrium(const Model& model, double tolerance, Equilibrium& run) {
    Shown shown;
    unlocked([&] { solve_equilibrium(model, tolerance, run, shown); });
    return shown_array(shown, model.train.meshes);
}

auto py_integrate(const Model& model, double tolerance, const State& origin, Equilibrium& run,
                  std::pair<double, double> span) {
    Shown shown;
    double out[TOTALS], peak[PEAKS][MESHES] = {};
    const EquilibriumSolver solver{model, tolerance, run, shown};
    unlocked([&] { integrate(solver, origin, {span.first, span.second}, out, peak); });
    return std::make_tuple(new_array(out, {TOTALS}), new_array(&peak[0][0], {PEAKS, MESHES}));
}

auto py_divide_cycle(const Model& model, double tolerance, const State& origin, Equilibrium& run,
                     const ConstArray& edges, double period) {
    Shown shown;
    const EquilibriumSolver solver{model, tolerance, run, shown};
    const std::span<const double> between{edges.data(), edges.size()};
    const Panels panels = unlocked([&] { return divide_cycle(solver, origin, between, period); });
    std::size_t m = panels.phase.size();
    return std::make_tuple(new_array(panels.phase.data(), {m}),
                           new_array(panels.totals.data()->data(), {m, TOTALS}),
                           new_array(panels.peaks.data()->data(), {m, PEAKS, MESHES}));
}

void py_integrate_panels(const Model& model, double tolerance, State& state, Equilibrium& run,
                         const ConstArray& edges, const InstantTuple& until, bool stop,
                         const Array& totals, const Array& peak) {
    check_size("totals", totals.size(), TOTALS);
    check_size("peak", peak.size(), PEAKS * MESHES);
    Unlocked release;
    Shown shown;
    integrate_panels({model, tolerance, run, shown}, state, {edges.data(), edges.size()},
                     instant_of(until), stop, totals.data(),
                     reinterpret_cast<double (*)[MESHES]>(peak.data()));
}

void py_follow_passages(const Model& model, double tolerance, State& state, Equilibrium& run,
                        const ConstArray& edges, const InstantTuple& until, Passages& passages,
                        MeshSums& sums) {
    Unlocked release;
    Shown shown;
    follow_passages({model, tolerance, run, shown}, state, {edges.data(), edges.size()},
                    instant_of(until), passages, sums);
}

void py_sample_equilibrium(const Model& model, double tolerance, const State& origin,
                           Equilibrium& run, const InstantTuple& at, const SamplesTuple& out,
                           std::int64_t row) {
    Samples samples = samples_of(out);
    if (row < 0 || row >= samples.rows) throw nb::index_error("row");
    Unlocked release;
    sample(model, tolerance, origin, run, instant_of(at), samples, row);
}

void py_sample_window(const Model& model, double tolerance, State& origin, Equilibrium& run,
                      const Report& report, const GridTuple& grid, WindowEnd& end) {
    const Waveform out = waveform_of(grid, report, model.train);
    Unlocked release;
    end.peaks = {};
    SampleRoom room(model.train, out, &end.peaks);
    sample_all(model, tolerance, origin, run, out.begin, room.samples());
    room.put(report, model.train, out);
}

void py_add_rates(const Train& train, const ConstArray& power, const ConstArray& shown,
                  double weight, const Array& out) {
    check_size("power", power.size(), LEDGER);
    check_size("shown", shown.size(), std::size_t(QUANTITIES * train.meshes));
    check_size("out", out.size(), TOTALS);
    Shown room;
    for (int q = 0; q < QUANTITIES; ++q)
        std::copy_n(shown.data() + q * train.meshes, train.meshes, room[q]);
    add_rates(train, power.data(), room, weight, out.data());
}

double py_steepest_torque(const Model& model, double tolerance, std::int64_t closing_side,
                          const State& origin, const ConstArray& speed) {
    check_size("speed", speed.size(), AXES);
    Unlocked release;
    return steepest_torque(model, tolerance, closing_side, origin, speed.data());
}

}  // namespace

void bind_quasi_static(nb::module_& m) {
    CONSTANTS(m, TOTALS, PEAKS, NEGLIGIBLE_FORCE);
    RECORD(m, Springs, copies, error, compliance, friction, steps);
    RECORD(m, Equilibrium, state, step, evaluation, before, closing_side, error, stiffness,
           clearance, force, torque, balance, external, springs, both_flanks);
    m.def("solve_windup", &solve_windup, "total"_a, "planets"_a, "springs"_a,
          "Wind-up [m] at which the forces of the planets on the ring add up to `total` [N].");
    m.def("first_guess", &first_guess, "closing_side"_a,
          "Initial guess of an equilibrium; open meshes close on `closing_side`.");
    m.def("solve_equilibrium", &py_solve_equilibrium, "model"_a, "tolerance"_a, "run"_a,
          "Solve for the equilibrium of `run`; quantities of the meshes (QUANTITIES, meshes).");
    m.def("advance_shafts", &advance_shafts, "model"_a, "origin"_a, "after"_a, "state"_a,
          "Set `state` to the position of the motors `after` seconds after `origin`.");
    m.def("weight_energy", &weight_energy, "train"_a, "state"_a,
          "Potential energy of the weight of bodies whose axes move [J].");
    m.def("join_flanks", &join_flanks, "train"_a, "sums"_a,
          "Give both entries of every mesh the forces, films and losses of both flanks.");
    m.def(
        "advance_origin",
        [](const Model& model, State& origin, const InstantTuple& until) {
            advance_origin(model, origin, instant_of(until));
        },
        "model"_a, "origin"_a, "until"_a, "Move `origin` to the last whole second before `until`.");
    m.def("integrate", &py_integrate, "model"_a, "tolerance"_a, "origin"_a, "run"_a, "span"_a,
          "Totals (TOTALS,) and peaks (PEAKS, MESHES) of a span of time since `origin` [s].");
    m.def("divide_cycle", &py_divide_cycle, "model"_a, "tolerance"_a, "origin"_a, "run"_a,
          "edges"_a, "period"_a,
          "Panels of one mesh cycle: edges (m,), totals up to them (m, TOTALS), and the peaks of\n"
          "the panel before each (m, PEAKS, MESHES).");
    m.def("integrate_panels", &py_integrate_panels, "model"_a, "tolerance"_a, "state"_a, "run"_a,
          "edges"_a, "until"_a, "stop"_a, "totals"_a, "peak"_a,
          "Integrate from `state`, which moves, panel by panel, up to `until`.");
    m.def("follow_passages", &py_follow_passages, "model"_a, "tolerance"_a, "state"_a, "run"_a,
          "edges"_a, "until"_a, "passages"_a, "sums"_a,
          "Add the damage from `state`, which moves, up to `until` to `sums`.");
    m.def(
        "repeat_passed",
        [](const MeshSums& cycle, std::int64_t times, std::int64_t stride, MeshSums& sums) {
            add_passed(cycle.passed, 0, times, stride, sums);
        },
        "cycle"_a, "times"_a, "stride"_a, "sums"_a,
        "Add passages of a cycle to `sums`, `times` in all, each `stride` mesh cycles later.");
    m.def(
        "take_passed", [](MeshSums& found, MeshSums& sums) { sums.passed.swap(found.passed); },
        "found"_a, "sums"_a, "Replace the passages of `sums` by those that were found.");
    m.def("skip_cycles", &skip_cycles, "train"_a, "cycles"_a, "passages"_a,
          "Go on counting passages after mesh cycles of the frame that were not followed.");
    m.def("sample_equilibrium", &py_sample_equilibrium, "model"_a, "tolerance"_a, "origin"_a,
          "run"_a, "at"_a, "out"_a, "row"_a, "Write the sample at an instant into a row of `out`.");
    m.def("sample_window", &py_sample_window, "model"_a, "tolerance"_a, "origin"_a, "run"_a,
          "report"_a, "grid"_a, "end"_a,
          "Fill the waveform, and the peaks of `end`; `origin` is advanced.");
    m.def("add_rates", &py_add_rates, "train"_a, "power"_a, "shown"_a, "weight"_a, "out"_a,
          "Add the rates at one instant, times `weight` [s], to the totals `out` (TOTALS,).");
    m.def("steepest_torque", &py_steepest_torque, "model"_a, "tolerance"_a, "closing_side"_a,
          "origin"_a, "speed"_a,
          "Largest change of the second motor's torque per mesh cycle [N m].");
}

}  // namespace gearbox
