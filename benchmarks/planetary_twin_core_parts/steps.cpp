// Parts of a step with fixed axes.

#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>

#include "bindings/unlocked.hpp"
#include "integrators/collocated_step.hpp"
#include "integrators/collocation.hpp"
#include "integrators/integrator.hpp"
#include "integrators/oscillator.hpp"
#include "integrators/propagation.hpp"
#include "integrators/rosenbrock.hpp"
#include "parts.hpp"
#include "vector/rows.hpp"

namespace gearbox {

namespace nb = nanobind;
using namespace nb::literals;

void bind_step_parts(nb::module_& m) {
    m.attr("NO_MESH") = NO_MESH;
    m.def("accept", &accept, "model"_a, "integrator"_a, "mesh"_a, nb::call_guard<Unlocked>(),
          "Accept the step; the contact of `mesh` changes at its end (-1: of no mesh).");
    m.def(
        "decay_rates",
        [](double square, double damping) {
            DecayRates rates = decay_rates(square, damping);
            return std::make_tuple(rates.rate, rates.slow_rate, rates.fast_rate);
        },
        "square"_a, "damping"_a, "Angular frequency and both decay rates [1/s].");
    m.def(
        "wave",
        [](double damping, double rate, double slow, double fast, double t) {
            Wave at = wave(damping, rate, slow, fast, t);
            return std::pair(at.cosine, at.sine);
        },
        "damping"_a, "rate"_a, "slow"_a, "fast"_a, "t"_a,
        "Free motions from (1, 0) and (0, 1) after `t` seconds.");
    m.def(
        "enter",
        [](const Model& model, Integrator& integrator) {
            with_lanes(model.train, [&](auto lanes) { enter<lanes>(model, integrator); });
        },
        "model"_a, "integrator"_a, "Express the start of a step in the modes of its contacts.");
    m.def(
        "set_step",
        [](const Model& model, Integrator& integrator, double h) {
            with_lanes(model.train, [&](auto lanes) { set_step<lanes>(integrator.run, h); });
        },
        "model"_a, "integrator"_a, "h"_a, "Free motions at the nodes of a step of `h` seconds.");
    m.def(
        "update_nodes",
        [](const Model& model, Integrator& integrator) {
            with_lanes(model.train, [&](auto lanes) { update_nodes<lanes>(model, integrator); });
        },
        "model"_a, "integrator"_a, "Compute the response to the present remainder at all nodes.");
    m.def(
        "sweep",
        [](const Model& model, Integrator& integrator, bool with_friction) {
            with_lanes(model.train,
                       [&](auto lanes) { sweep<lanes>(model, integrator, with_friction); });
        },
        "model"_a, "integrator"_a, "with_friction"_a, "Evaluate the remainder at all nodes.");
    m.def("end_within", &end_within, "model"_a, "integrator"_a, "h"_a,
          "End the collocation step after `h` seconds, without computing it again.");
    m.def("rosenbrock_step", &rosenbrock_step, "model"_a, "state"_a, "constants"_a, "h"_a,
          "first"_a, "out"_a, "work"_a,
          "Advance `state` by `h` seconds into `out` by Rosenbrock's method.");
}

}  // namespace gearbox
