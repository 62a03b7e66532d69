// The train, its meshes and the initial state of a run for Python.

#include <vector>

#include <nanobind/stl/tuple.h>

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "bindings/unlocked.hpp"
#include "bindings/vectors.hpp"
#include "mesh/pair_loads.hpp"
#include "model/drag.hpp"
#include "model/energy.hpp"
#include "model/equations.hpp"
#include "model/initial_state.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

void bind_cycle(nb::module_& m) {
    m.def(
        "cycle_shift",
        [](const Train& train, const Vector& x) { return cycle_shift(train, bodies(x)); },
        "train"_a, "x"_a, "Mesh cycles by which the train is ahead of the rigid frame.");
    m.def("frame_cycle", &frame_cycle, "train"_a, "state"_a, "modulus"_a,
          "Mesh cycles of the rigid frame since the start, modulo `modulus`.");
    m.def("set_step_constants", &set_step_constants, "model"_a, "state"_a, "step"_a,
          "Fill `step` for a step that begins at `state`.");
    m.def("frame_cycle_rate", &frame_cycle_rate, "train"_a, "state"_a,
          "Mesh cycles per second of the rigid frame, signed.");
    m.def("damping_time", &damping_time, "train"_a, "kind"_a, "rate"_a);
}

void bind_form(nb::module_& m) {
    m.def(
        "share_force",
        [](const Train& train, StepConstants& step, std::int64_t i, const Vector& cycles,
           const Table& counted, const Vector& force, const Rows& position, const Rows& ahead,
           const Rows& face, const Rows& load) {
            std::size_t count = force.size(), size = count * PAIRS;
            const auto faults = static_cast<std::size_t>(train.faults.count);
            const double* own = entries(counted, count * faults);
            PairContacts all{entries(position, size), entries(ahead, size), entries(face, size),
                             entries(load, size)};
            const double* reached = entries(cycles, count);
            Unlocked unlocked;
            for (std::size_t n = 0; n < count; ++n) {
                if (force.data()[n] == 0.0) continue;
                std::size_t row = n * PAIRS;
                share_force(train, step, i, reached[n], own + n * faults, force.data()[n],
                            {all.position + row, all.ahead + row, all.face + row, all.load + row});
            }
        },
        "train"_a, "step"_a, "i"_a, "cycles"_a, "counted"_a, "force"_a, "position"_a, "ahead"_a,
        "face"_a, "load"_a,
        "Fill the contacts (n, PAIRS) of the pairs of mesh i from forces (n,).");
}

void bind_equations(nb::module_& m) {
    m.def(
        "forces",
        [](const Model& model, const State& state, const StepConstants& step, const Vector& x,
           const Vector& v, double delay, const Vector& trim, Evaluation& out) {
            const double *at = bodies(x), *speeds = bodies(v), *trims = entries(trim, AXES);
            Unlocked unlocked;
            forces(model, state, step, at, speeds, delay, trims, out);
        },
        "model"_a, "state"_a, "step"_a, "x"_a, "v"_a, "delay"_a, "trim"_a, "out"_a,
        "Forces on all bodies in coordinates x, `delay` seconds after the start of a step.");
    m.def(
        "rolling_bearing_law",
        [](const RollingBearing& bearing, double clearance, const Vector& size) {
            const std::size_t count = size.size();
            std::vector<double> found(3 * count);
            for (std::size_t i = 0; i < count; ++i) {
                const BearingResponse at = rolling_bearing_law(bearing, clearance, size.data()[i]);
                found[i] = at.energy;
                found[count + i] = at.force;
                found[2 * count + i] = at.stiffness;
            }
            return new_array(found.data(), {3, count});
        },
        "bearing"_a, "clearance"_a, "size"_a,
        "Energy [J], force [N] and stiffness [N/m] of a rolling bearing per eccentricity, (3, n).");
    m.def("kinetic", &kinetic, "model"_a, "state"_a, "Kinetic energy of all bodies [J].");
}

void bind_initial_state(nb::module_& m) {
    RECORD(m, InitialState, state, unbalanced, body);
    m.def(
        "initial_state",
        [](const Model& model, const ConstArray& speed, double force) {
            check_size("speed", speed.size(), AXES);
            Unlocked unlocked;
            return initial_state(model, speed.data(), force);
        },
        "model"_a, "speed"_a, "force"_a,
        "State at the start of a run, see `InitialState`.\n\n"
        "`speed`: of the motors (AXES,) [rad/s]. `force`: mean force of every mesh [N].");
}

}  // namespace

void bind_model(nb::module_& m) {
    CONSTANTS(m, DAMAGES, EXTREMES, FLANK_DAMAGE, ROOT_DAMAGE, PASSAGE, OF_SIDE, BEARING_DAMAGE,
              SHAFT_DAMAGE, MEMBER_DAMAGE, CONTACT_STRESS, ROOT_STRESS, HOTTEST, ROUGHEST,
              CURVE_POINTS, ROOT_TERMS);
    CONSTANTS(m, REGISTER, BODIES, MESHES, MACHINES, AXES, PAIRS, TOTAL, SEGMENTS, TERMS, LINES,
              FAULTS, FAULT_FACTORS, FAULT_GAPS, JOINTS, DRIVE_SIDE, COAST_SIDE, WORK, IMPULSE,
              FRICTION, DAMPING, BEARING, CHURNING, STIFFNESS_WORK, WEIGHT, HEAT, LEDGER, DTE,
              MESH_FORCE, BOUNDARY, VISCOUS, FILM, LAMBDA, POWER_LOSS, MESH_POWER, QUANTITIES,
              CONTACT, CLIPPED, SUMS, NO_PLANET, NOWHERE);
    bind_cycle(m);
    bind_form(m);
    bind_equations(m);
    bind_initial_state(m);
}

}  // namespace gearbox
