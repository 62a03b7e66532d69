// Positions, contacts and forces of meshes with fixed axes, and how they are observed.

#include <algorithm>

#include <nanobind/stl/tuple.h>

#include "matrices.hpp"
#include "mesh/backlash.hpp"
#include "model/drag.hpp"
#include "model/observe.hpp"
#include "model/set_step_constants.hpp"
#include "parts.hpp"

namespace gearbox {

using namespace nb::literals;

void bind_mesh_parts(nb::module_& m) {
    m.attr("PAIR_CAPACITY") = PAIR_CAPACITY;
    m.attr("OPEN") = OPEN;
    m.attr("SLOWEST_TURN") = SLOWEST_DRAG_TURN;
    m.def("find_segment", &find_segment, "train"_a, "kind"_a, "cycle"_a, "direction"_a,
          "Segment of the table of tooth pairs at a fraction of the cycle.");
    m.def("copy_segment", &copy_segment, "train"_a, "state"_a, "step"_a, "i"_a);
    m.def(
        "place_lines",
        [](const Train& train, const State& state, std::int64_t i, const Lines& angle) {
            place_lines(train, state, i, lines(angle));
        },
        "train"_a, "state"_a, "i"_a, "angle"_a);
    m.def(
        "form_error",
        [](const Train& train, std::int64_t i, double side, const Lines& angle, double advance,
           double cycle_rate) {
            auto [e, rate] = form_error(train, i, side, lines(angle), advance, cycle_rate);
            return std::tuple(e, rate);
        },
        "train"_a, "i"_a, "side"_a, "angle"_a, "advance"_a, "cycle_rate"_a);
    m.def("mesh_stiffness", &mesh_stiffness, "train"_a, "i"_a, "segment"_a, "cycle"_a,
          "Stiffness [N/m] of mesh i without faults at a fraction of its cycle.");
    m.def(
        "mesh_motion",
        [](const Train& train, std::int64_t i, const Vector& x) {
            return mesh_motion(train, i, bodies(x));
        },
        "train"_a, "i"_a, "x"_a, "Transmission error of mesh i from x, its rate from v.");
    m.def(
        "contact_event",
        [](const Model& model, const State& state, const StepConstants& step, std::int64_t i,
           const Vector& x, const Vector& v, std::tuple<double, double, double> position) {
            auto [advance, cycle_rate, slack] = position;
            return contact_event(model, state, step, i, bodies(x), bodies(v),
                                 {advance, cycle_rate, slack});
        },
        "model"_a, "state"_a, "step"_a, "i"_a, "x"_a, "v"_a, "position"_a,
        "Gap [m] left to mesh i before its contact changes; negative: it has changed.");
    m.def(
        "body_speed",
        [](const Train& train, const State& state, const Vector& v, std::int64_t j) {
            return body_speed(train, state, bodies(v), j);
        },
        "train"_a, "state"_a, "v"_a, "j"_a, "Absolute speed of body j [rad/s].");
    m.def(
        "apply_drag",
        [](const Model& model, const State& state, const Vector& v, Evaluation& out) {
            apply_drag(model, state, bodies(v), out.now.normal_force, out.friction_force,
                       out.power);
        },
        "model"_a, "state"_a, "v"_a, "out"_a,
        "Add the drag of joints and discs to out.friction_force, and its power to out.power.");
    m.def(
        "observe",
        [](const Model& model, const State& state, const StepConstants& step, const Vector& x,
           const Vector& v, double delay, Evaluation& work, const Rows& out) {
            const double *at = bodies(x), *speeds = bodies(v);
            auto room = static_cast<std::int64_t>(out.shape(1));
            if (out.shape(0) < QUANTITIES || room < model.train.meshes)
                throw nb::value_error("out: must have room for all quantities of all meshes");
            Unlocked unlocked;
            double shown[QUANTITIES][MESHES];
            observe(model, state, step, at, speeds, delay, work, shown);
            for (int q = 0; q < QUANTITIES; ++q)
                std::copy_n(shown[q], model.train.meshes, out.data() + q * room);
        },
        "model"_a, "state"_a, "step"_a, "x"_a, "v"_a, "delay"_a, "work"_a, "out"_a,
        "Fill out[:, i] for every mesh i; film and lambda ratio are NaN without contact.");
}

}  // namespace gearbox
