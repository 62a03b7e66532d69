// Ports of a train, for `planetary_twin_py.ports`.

#include <array>
#include <limits>
#include <optional>

#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>

#include "bindings/arrays.hpp"
#include "bindings/interruptible.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "run/ports.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

using Given = std::optional<double>;

// planetary_twin_py's Command: torque, speed and position, at input and output each.
using CommandTuple = std::array<Given, 3 * PORTS>;

// A value that is not given does not change; NaN is out of range.
double value_of(const Given& given) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    if (!given) return std::numeric_limits<double>::quiet_NaN();
    return std::isnan(*given) ? infinite : *given;
}

// A command from `now` on, whose positions are reached after `duration` seconds.
Command command_of(const Model& model, Integrator& integrator, const Instant& now, double duration,
                   const CommandTuple& given) {
    Command command = NO_COMMAND;
    double position[PORTS];
    for (int port = 0; port < PORTS; ++port) {
        command.torque[port] = value_of(given[port]);
        command.speed[port] = value_of(given[PORTS + port]);
        position[port] = value_of(given[2 * PORTS + port]);
    }
    if (given[2 * PORTS + MOTOR] || given[2 * PORTS + LOAD_MACHINE])
        approach(model, integrator, now, duration, position, command);
    return command;
}

template <int port>
void bind_port(nb::class_<PortStates>& states, const char* angle, const char* speed,
               const char* torque) {
    states.def_prop_ro(
        angle, [](const PortStates& self) { return self.angle[port]; },
        "Angle, which counts whole turns; 0 at rest in the middle of the backlash [rad].");
    states.def_prop_ro(
        speed, [](const PortStates& self) { return self.speed[port]; }, "Speed [rad/s].");
    states.def_prop_ro(
        torque, [](const PortStates& self) { return self.torque[port]; },
        "Torque on the train [N m].");
}

// One line of both shafts, with units.
nb::str text_of(const PortStates& self) {
    const nb::str form(
        "PortStates({:.9g} s, input {:.6g} rad, {:.6g} rad/s, {:.6g} N m, "
        "output {:.6g} rad, {:.6g} rad/s, {:.6g} N m)");
    return nb::str(form.format(self.time, self.angle[MOTOR], self.speed[MOTOR], self.torque[MOTOR],
                               self.angle[LOAD_MACHINE], self.speed[LOAD_MACHINE],
                               self.torque[LOAD_MACHINE]));
}

void bind_port_states(nb::module_& m) {
    nb::class_<PortStates> states(m, "PortStates",
                                  "Angles, speeds and torques of the input and the output shaft.");
    states.def(nb::init<>());
    states.def_ro("time", &PortStates::time, "Simulated time [s].");
    bind_port<MOTOR>(states, "input_angle", "input_speed", "input_torque");
    bind_port<LOAD_MACHINE>(states, "output_angle", "output_speed", "output_torque");
    states.def("__repr__", &text_of);
    states.def(
        "copy", [](const PortStates& self) { return PortStates(self); },
        "A copy, which later steps do not change.");
}

// Apply the command if the ports accept it; return whether they do.
bool py_apply_command(Model& model, Integrator& integrator, std::int64_t begin, std::int64_t end,
                      const CommandTuple& given, bool linear, const PortRanges& ranges) {
    const Instant now = instant_of(begin);
    const double duration = seconds_of(end - begin);
    const Command command = command_of(model, integrator, now, duration, given);
    if (check(model.operation, ranges, command) != Answer::ACCEPTED) return false;
    run_unlocked([&] { apply_command(model, integrator, now, command, linear ? duration : 0.0); });
    return true;
}

int py_step_ports(Model& model, Integrator& integrator, std::int64_t begin, std::int64_t end,
                  const CommandTuple& given, bool linear, const PortRanges& ranges,
                  const Limits& limits, WindowEnd& reached, PortStates& out) {
    PortStep step{begin, end,
                  command_of(model, integrator, instant_of(begin), seconds_of(end - begin), given),
                  linear};
    if (check(model.operation, ranges, step.command) != Answer::ACCEPTED)
        return static_cast<int>(Outcome::REFUSED);
    Interruptible unlocked;
    return static_cast<int>(step_ports(model, integrator, step, limits, reached, out));
}

}  // namespace

void bind_ports(nb::module_& m) {
    CONSTANTS(m, BY_MACHINE, BY_TORQUE, BY_MOTION, PORTS);
    m.attr("REFUSED") = static_cast<int>(Outcome::REFUSED);
    RECORD(m, PortRanges, torque, speed);
    bind_port_states(m);
    m.def("step_ports", &py_step_ports, "model"_a, "integrator"_a, "begin"_a, "end"_a, "command"_a,
          "linear"_a, "ranges"_a, "limits"_a, "reached"_a, "out"_a,
          "Apply the command at `begin` [ticks], and integrate to `end`; returns the outcome.\n\n"
          "`None`: the value does not change.");
    m.def(
        "apply_command", &py_apply_command, "model"_a, "integrator"_a, "begin"_a, "end"_a,
        "command"_a, "linear"_a, "ranges"_a,
        "Apply a command from `begin` [ticks] on; with `linear`, its values are reached at "
        "`end`.\n\nPositions are always reached at `end`. Returns whether the ports accept it.\n\n"
        "Raises:\n    ArithmeticError: no finite state can be reached.");
    m.def(
        "read_ports",
        [](const Model& model, Integrator& integrator, const InstantTuple& time, PortStates& out) {
            read_ports(model, integrator, instant_of(time), out);
        },
        "model"_a, "integrator"_a, "time"_a, "out"_a,
        "Fill `out` with the state of the ports at `time`, within the last step.");
}

}  // namespace gearbox
