// Parts of a step with fixed axes, for tests of the order of convergence.

#include "bindings/parts.hpp"
#include "integrators/collocated_step.hpp"
#include "integrators/collocation.hpp"
#include "integrators/propagation.hpp"
#include "integrators/rosenbrock.hpp"
#include "vector/rows.hpp"

namespace gearbox {

using namespace nanobind::literals;

void bind_parts_of_steps(nanobind::module_& m) {
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
