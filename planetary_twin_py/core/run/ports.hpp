#pragma once

// Ports: the shafts of the first motor (input) and of the load (output), at which torque or motion
// may be given from outside, and changed at every step of the caller.

#include <cmath>
#include <cstdint>
#include <limits>

#include "integrators/integrator_record.hpp"
#include "run/clock.hpp"
#include "run/limits.hpp"
#include "run/window.hpp"
#include "train/model.hpp"

namespace gearbox {

constexpr int PORTS = 2;                           // MOTOR and LOAD_MACHINE
constexpr std::int64_t TICKS = 1'000'000'000'000;  // per second, of the clock of the caller

inline Instant instant_of(std::int64_t ticks) {
    return {ticks / TICKS, static_cast<double>(ticks % TICKS) / static_cast<double>(TICKS)};
}

// What is given at the ports; a NaN: what acts stays as it is.
struct Command {
    double torque[PORTS];    // on the shaft [N m]
    double speed[PORTS];     // of the shaft [rad/s]; with an approach, from its end on
    double approach[PORTS];  // constant speed at which it reaches a given position [rad/s]
};

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
constexpr Command NO_COMMAND{
    {NOT_A_NUMBER, NOT_A_NUMBER}, {NOT_A_NUMBER, NOT_A_NUMBER}, {NOT_A_NUMBER, NOT_A_NUMBER}};

// Largest magnitudes that may be given.
struct PortRanges {
    double torque[PORTS];  // [N m]
    double speed[PORTS];   // [rad/s]
};

// What the ports show.
struct PortStates {
    double time;           // [s]
    double angle[PORTS];   // since the start [rad]
    double speed[PORTS];   // [rad/s]
    double torque[PORTS];  // on the train [N m]
};

// What a command may find.
enum class Answer { ACCEPTED, OUT_OF_RANGE, NOT_GIVEN };

// Whether the ports take a command: its values are in their ranges, and what it gives is given.
Answer check(const Load& load, const PortRanges& ranges, const Command& command);

// Let the shafts reach positions [rad] at constant speed, `duration` seconds after `now`; a NaN: no
// position is given.
void approach(const Model& model, Integrator& integrator, const Instant& now, double duration,
              const double* position, Command& command);

// Let a command act from `now` on, the end of the last window: at once, or, where `reaching` is not
// 0, along straight lines that reach its values after so many seconds. What the meshes show in the
// last step counts up to `now`. Throws NoFiniteState.
void apply_command(Model& model, Integrator& integrator, const Instant& now, const Command& command,
                   double reaching);

// What the ports show at `time`, within the last step.
void read_ports(const Model& model, Integrator& integrator, const Instant& time, PortStates& out);

// A stretch of time under a command.
struct PortStep {
    std::int64_t begin;  // [ticks]
    std::int64_t end;    // [ticks]
    Command command;
    bool linear;        // whether the values are reached along straight lines, at its end
    bool sums = false;  // whether the meshes are summed up although commands act
};

// Give the command, integrate to the end of the step without samples, and fill `out` and, with what
// the limits are checked against, `end`.
Outcome step_ports(Model& model, Integrator& integrator, const PortStep& step, const Limits& limits,
                   WindowEnd& end, PortStates& out);

}  // namespace gearbox
