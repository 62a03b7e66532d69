#include "run/ports.hpp"

#include <algorithm>

#include "integrators/frame.hpp"
#include "integrators/integrator.hpp"
#include "integrators/interpolant.hpp"
#include "integrators/methods.hpp"
#include "integrators/window_sums.hpp"
#include "mesh/deflection.hpp"
#include "model/equations.hpp"

namespace gearbox {

namespace {

// Input of a port: a torque [N m] or a speed [rad/s], and its rate of change. The speed of an
// approach to a position is followed by another one.
struct Action {
    double value;
    double rate;
    bool reaches_position = false;
    double speed_after = 0.0;

    bool operator==(const Action&) const = default;
};

// Input of a port, `passed` seconds after the instant of the load.
Action acting(const Operation& operation, int port, double passed) {
    if (operation.port[port] == BY_MOTION)
        return {operation.speed[port] + operation.acceleration[port] * passed,
                operation.acceleration[port], operation.reaches_position[port] != 0,
                operation.speed_after[port]};
    return {operation.torque[port] + operation.torque_rate[port] * passed,
            operation.torque_rate[port]};
}

// Input of a port under a command.
Action commanded(const Operation& operation, int port, const Action& before, const Command& command,
                 double reaching) {
    const bool moved = operation.port[port] == BY_MOTION;
    const double value = moved ? command.speed[port] : command.torque[port];
    const double approach = moved ? command.approach[port] : NOT_A_NUMBER;
    if (!std::isnan(approach)) return {approach, 0.0, true, std::isnan(value) ? 0.0 : value};
    const double now = before.reaches_position ? before.speed_after : before.value;
    if (std::isnan(value)) return {now, 0.0};
    if (reaching == 0.0) return {value, 0.0};
    return {now, (value - now) / reaching};
}

// Set the speed of the end of a shaft, without any other change.
void set_speed(const Train& train, State& state, int machine, double speed) {
    std::int64_t body = train.coupling.ends[machine][0];
    state.v[body] = (speed - rigid_speed(train, state, body)) * train.body.radius[body];
}

// Inputs of both ports from an instant on.
struct Actions {
    Action at[PORTS];
    bool change;
};

Actions actions_of(const Operation& operation, const Instant& now, const Command& command,
                   double reaching) {
    double passed =
        static_cast<double>(now.seconds - operation.since_seconds) + (now.time - operation.since);
    Actions actions{};
    for (int port = 0; port < PORTS; ++port) {
        if (operation.port[port] == BY_MACHINE) continue;
        Action before = acting(operation, port, passed);
        actions.at[port] = commanded(operation, port, before, command, reaching);
        actions.change |= !(before == actions.at[port]);
    }
    return actions;
}

void act_at(Model& model, State& state, int port, const Action& action) {
    Operation& operation = model.operation;
    if (operation.port[port] != BY_MOTION) {
        operation.torque[port] = action.value;
        operation.torque_rate[port] = action.rate;
        return;
    }
    operation.speed[port] = action.value;
    operation.acceleration[port] = action.rate;
    operation.reaches_position[port] = action.reaches_position;
    operation.speed_after[port] = action.speed_after;
    set_speed(model.train, state, port, action.value);
}

// Start new inputs at an instant within the last step. The sums of the meshes restart there.
void act(Model& model, Integrator& integrator, const Instant& now, const Actions& actions) {
    Operation& operation = model.operation;
    interrupt(model, integrator, now);
    operation.since_seconds = now.seconds;
    operation.since = now.time;
    for (int port = 0; port < PORTS; ++port)
        if (operation.port[port] != BY_MACHINE)
            act_at(model, integrator.end, port, actions.at[port]);
    integrator.sums.taken = integrator.control.step;
}

// Whether a torque or motion is given: then cycles do not repeat, and steps without a window need
// no sums.
bool is_driven(const Operation& operation) {
    return operation.port[MOTOR] != BY_MACHINE || operation.port[LOAD_MACHINE] != BY_MACHINE;
}

// Angle of a shaft since the start, `passed` seconds into the last step [rad].
double angle_at(const Train& train, const Integrator& integrator, int port, double passed) {
    const State& begin = integrator.begin;
    const std::int64_t body = train.coupling.ends[port][0];
    double angle = integrator.dense.x[body] / train.body.radius[body];
    for (std::int64_t a = 0; a < train.axes; ++a)
        angle += train.body.ratio[a][body] *
                 (TURN * (begin.turns[a] + begin.fraction[a]) + begin.speed[a] * passed);
    return angle;
}

// Update the largest magnitudes with the motion at the end of a step of the caller.
void note_peaks(const Model& model, const Integrator& integrator, Peaks& peaks) {
    const Train& train = model.train;
    for (std::int64_t i = 0; i < train.meshes; ++i)
        peaks.dte[i] = std::fabs(mesh_motion(train, i, integrator.dense.x));
    for (std::int64_t j = 0; j < train.bodies; ++j)
        peaks.speed[j] = std::fabs(body_speed(train, integrator.begin, integrator.dense.v, j));
}

}  // namespace

Answer check(const Operation& operation, const PortRanges& ranges, const Command& command) {
    for (int port = 0; port < PORTS; ++port) {
        const double torque = command.torque[port], speed = command.speed[port];
        const double approach = command.approach[port];
        const bool moved = !std::isnan(speed) || !std::isnan(approach);
        bool misplaced = (!std::isnan(torque) && operation.port[port] != BY_TORQUE) ||
                         (moved && operation.port[port] != BY_MOTION);
        if (misplaced) return Answer::NOT_GIVEN;
        if (std::fabs(torque) > ranges.torque[port] || std::fabs(speed) > ranges.speed[port] ||
            std::fabs(approach) > ranges.speed[port])
            return Answer::OUT_OF_RANGE;
    }
    return Answer::ACCEPTED;
}

void approach(const Model& model, Integrator& integrator, const Instant& now, double duration,
              const double* position, Command& command) {
    const double passed = delay(integrator.begin, now);
    interpolate(model, integrator, passed);
    for (int port = 0; port < PORTS; ++port) {
        if (std::isnan(position[port])) continue;
        const double angle = angle_at(model.train, integrator, port, passed);
        command.approach[port] = (position[port] - angle) / duration;
    }
}

void apply_command(Model& model, Integrator& integrator, const Instant& now, const Command& command,
                   double reaching) {
    Actions actions = actions_of(model.operation, now, command, reaching);
    if (!actions.change) return;
    count_until(model, integrator, delay(integrator.begin, now));
    act(model, integrator, now, actions);
}

void read_ports(const Model& model, Integrator& integrator, const Instant& time, PortStates& out) {
    const Train& train = model.train;
    const State& begin = integrator.begin;
    const double passed = delay(begin, time);
    const double *x = integrator.dense.x, *v = integrator.dense.v;
    double trim[AXES] = {};
    interpolate(model, integrator, passed);
    trim_at(model, integrator, passed, x, trim);
    MachineForces forces;
    double power[LEDGER] = {};
    apply_couplings(train, x, v, forces, power);
    apply_machines(model, begin, integrator.constants, x, v, passed, trim, forces, power);
    out.time = static_cast<double>(time.seconds) + time.time;
    for (int port = 0; port < PORTS; ++port) {
        out.angle[port] = angle_at(train, integrator, port, passed);
        out.speed[port] = body_speed(train, begin, v, train.coupling.ends[port][0]);
        out.torque[port] = power[IMPULSE + port];
    }
}

Outcome step_ports(Model& model, Integrator& integrator, const PortStep& step, const Limits& limits,
                   WindowEnd& end, PortStates& out) {
    const Instant now = instant_of(step.begin), until = instant_of(step.end);
    const double duration = seconds_of(step.end - step.begin);
    Actions actions = actions_of(model.operation, now, step.command, step.linear ? duration : 0.0);
    bool finite = true;
    integrator.sums.not_requested =
        is_driven(model.operation) && !step.sums && !model.train.durability.active;
    try {
        if (actions.change && step.sums)
            count_until(model, integrator, delay(integrator.begin, now));
        if (actions.change) act(model, integrator, now, actions);
        advance(model, integrator, until, NEVER, {});
    } catch (const NoFiniteState&) {
        finite = false;
    }
    integrator.sums.not_requested = false;
    if (!finite) return Outcome::NOT_FINITE;
    read_ports(model, integrator, until, out);
    note_peaks(model, integrator, end.peaks);
    std::fill(std::begin(end.power), std::end(end.power), 0.0);
    std::copy_n(out.torque, PORTS, end.power + IMPULSE);
    bool exceeded = exceeds(limits, model.train, model.operation, end.peaks, end.power);
    return exceeded ? Outcome::EXCEEDED : Outcome::WITHIN_LIMITS;
}

}  // namespace gearbox
