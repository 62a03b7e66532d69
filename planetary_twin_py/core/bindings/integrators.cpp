// Integration of a run, for `planetary_twin_py.run.engine`.

#include "bindings/arrays.hpp"
#include "bindings/interruptible.hpp"
#include "bindings/parts.hpp"
#include "bindings/unlocked.hpp"
#include "integrators/integrator.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/methods.hpp"

namespace gearbox {

namespace {

using namespace nb::literals;

void py_advance(const Model& model, Integrator& integrator, const InstantTuple& until,
                const InstantTuple& bound, const SamplingTuple& samples, const SamplesTuple& out) {
    Samples room = samples_of(out);
    if (room.rows < 1) throw std::invalid_argument("samples: no room for the one at the end");
    --room.rows;
    Grid grid{sampling_of(samples), room};
    run_unlocked([&] {
        advance(model, integrator, instant_of(until), instant_of(bound), {&grid, 1},
                room.only(room.rows));
    });
}

void py_cut(const Model& model, Integrator& integrator, const InstantTuple& until) {
    run_unlocked([&] { cut(model, integrator, instant_of(until)); });
}

void py_sample(const Model& model, Integrator& integrator, double delay, const SamplesTuple& out,
               std::int64_t row) {
    Samples room = samples_of(out);
    if (row < 0 || row >= room.rows) throw std::invalid_argument("samples: no such row");
    run_unlocked([&] { sample(model, integrator, delay, room, row); });
}

Nodes py_radau(int points) {
    if (points < 1 || points > MOST_NODES)
        throw std::invalid_argument("points: 1 to " + std::to_string(MOST_NODES));
    Nodes nodes;
    radau(points, nodes);
    return nodes;
}

}  // namespace

void bind_integrators(nb::module_& m) {
    nb::dict methods;
    for (auto [name, method] : METHODS) methods[name] = static_cast<int>(method);
    m.attr("METHODS") = methods;
    m.def("begin_step", &begin_step, "model"_a, "integrator"_a, nb::call_guard<Unlocked>(),
          "Start a new step where the last one ended.");
    m.def("advance", &py_advance, "model"_a, "integrator"_a, "until"_a, "bound"_a, "samples"_a,
          "out"_a,
          "Integrate to `until`, and fill `out` with `samples` and one at `until`.\n\n"
          "No step that is made passes `bound`.\n\n"
          "Raises:\n    ArithmeticError: no finite state can be reached.");
    m.def("cut", &py_cut, "model"_a, "integrator"_a, "until"_a,
          "Repeat the last step so that it ends at `until`, which lies within it.\n\n"
          "Raises:\n    ArithmeticError: no finite state can be reached.");
    m.def("interpolate", &interpolate, "model"_a, "integrator"_a, "delay"_a,
          nb::call_guard<Unlocked>(),
          "Fill x and v of `integrator.dense`, `delay` seconds into the last step.");
    m.def("sample", &py_sample, "model"_a, "integrator"_a, "delay"_a, "out"_a, "row"_a,
          "Write the sample `delay` seconds after the start of the last step to a row of `out`.");
    m.def("radau", &py_radau, "points"_a, "Radau points; `points` is their number.");
}

}  // namespace gearbox
