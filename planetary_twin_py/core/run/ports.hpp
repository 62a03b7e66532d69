#pragma once

// Ports: the shafts of the first motor (input) and of the load (output), at which the caller may
// give torque or motion, and change it at each of its steps.

#include <cstdint>
#include <limits>

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"
#include "run/clock.hpp"
#include "run/limits.hpp"
#include "run/window.hpp"

namespace gearbox {

constexpr int PORTS = 2;                           // MOTOR and LOAD_MACHINE
constexpr std::int64_t TICKS = 1'000'000'000'000;  // per second, of the clock of the caller

inline double seconds_of(std::int64_t ticks) {
    return static_cast<double>(ticks) / static_cast<double>(TICKS);
}

inline Instant instant_of(std::int64_t ticks) {
    return {ticks / TICKS, seconds_of(ticks % TICKS)};
}

// Given values at the ports; NaN: no change.
struct Command {
    double torque[PORTS];    // on the shaft [N m]
    double speed[PORTS];     // of the shaft [rad/s]; with an approach, after its end
    double approach[PORTS];  // constant speed of the approach to a given position [rad/s]
};

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr Command NO_COMMAND{
    {NOT_A_NUMBER, NOT_A_NUMBER}, {NOT_A_NUMBER, NOT_A_NUMBER}, {NOT_A_NUMBER, NOT_A_NUMBER}};

// Largest allowed magnitudes of given values.
struct PortRanges {
    double torque[PORTS];  // [N m]
    double speed[PORTS];   // [rad/s]
};

// State of the ports.
struct PortStates {
    double time;           // [s]
    double angle[PORTS];   // since the start [rad]
    double speed[PORTS];   // [rad/s]
    double torque[PORTS];  // on the train [N m]
};

// Results of the check of a command.
enum class Answer { ACCEPTED, OUT_OF_RANGE, NOT_GIVEN };

// Check a command: whether its values are in their ranges, and of quantities that are given at the
// ports.
Answer check(const Operation& operation, const PortRanges& ranges, const Command& command);

// Set the constant speeds at which the shafts reach positions [rad] `duration` seconds after `now`;
// NaN: no position is given.
void approach(const Model& model, Integrator& integrator, const Instant& now, double duration,
              const double* position, Command& command);

// Apply a command from `now` on, the end of the last window: as a step, or as a ramp over
// `reaching` seconds if that is not 0. The sums of the meshes include the last step
// up to `now`. Throws NoFiniteState.
void apply_command(Model& model, Integrator& integrator, const Instant& now, const Command& command,
                   double reaching);

// State of the ports at `time`, within the last step.
void read_ports(const Model& model, Integrator& integrator, const Instant& time, PortStates& out);

// A time interval under a command.
struct PortStep {
    std::int64_t begin;  // [ticks]
    std::int64_t end;    // [ticks]
    Command command;
    bool linear;        // whether the values change linearly until its end
    bool sums = false;  // whether the meshes are summed up although values are given
};

// Apply the command, integrate to the end of the step without samples, and fill `out` and, for the
// check of the limits, `end`.
Outcome step_ports(Model& model, Integrator& integrator, const PortStep& step, const Limits& limits,
                   WindowEnd& end, PortStates& out);

}  // namespace gearbox
