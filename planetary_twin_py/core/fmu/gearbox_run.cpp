#include "fmu/gearbox_run.hpp"

#include <algorithm>
#include <memory>

#include "integrators/integrator.hpp"
#include "model/energy.hpp"
#include "model/initial_state.hpp"
#include "run/window.hpp"

namespace gearbox {

namespace {

Instant now(const RunState& run) {
    return instant_of(run.ticks);
}

void set_nodes(const Exported& scene, RunState& run) {
    for (int n = 0; n < NODE_CHOICES; ++n) {
        if (!(run.tolerance > scene.least_tolerance[n])) continue;
        if (run.integrator.run.nodes.count != scene.points[n])
            radau(static_cast<int>(scene.points[n]), run.integrator.run.nodes);
        return;
    }
}

bool warms(const Exported& scene) {
    return scene.warming.period > 0;
}

void begin_temperatures(const Exported& scene, RunState& run) {
    run.network = scene.warming.network;
    run.network.ambient = run.wanted.ambient_temperature;
    if (scene.warming.starts_ambient)
        std::fill_n(run.network.temperature, NODES, run.network.ambient);
}

// Let the temperatures follow the losses up to now.
void take_heat(RunState& run) {
    const double duration = seconds_of(run.ticks - run.heated);
    run.heated = run.ticks;
    if (duration > 0.0) warm_up(run.model, run.integrator, run.network, now(run), duration);
}

// Apply the wanted operating point to the model, and scale the tolerances by it.
void load_point(const Exported& scene, RunState& run) {
    const OperatingPoint& point = run.wanted;
    Model& model = run.model;
    Control& control = run.integrator.control;
    if (!run.started || point.lambda_ratio != run.point.lambda_ratio)
        prescribe(model.oil, point.lambda_ratio);
    if (warms(scene)) warm_oil(run.network, model.oil);
    Operation operation = operation_at(scene.laws, point);
    if (run.started) keep_given(model.operation, operation);
    model.operation = operation;
    control.tolerance = run.tolerance;
    control.deflection = deflection_at(scene.laws, point);
    control.elastic_deflection = elastic_deflection(scene.laws, point);
    set_nodes(scene, run);
    control.changed = true;
    const Repetition& repetition = scene.repetition[operation.ripple != 0.0];
    run.integrator.periodic.cycles = repetition.cycles;
    run.integrator.periodic.numerator = repetition.numerator;
    run.integrator.periodic.denominator = repetition.denominator;
    run.point = point;
}

// Samples of all quantities at one instant.
struct OneSample {
    double mesh[QUANTITIES * MESHES], turns[AXES], angle[BODIES], speed[BODIES],
        drag[SAMPLE_DRAGS] = {};

    Samples room(const Train& train) {
        return {1, QUANTITIES, train.meshes, train.bodies, AXES, mesh, turns, angle, speed, drag};
    }
};

OneSample sample_now(RunState& run) {
    OneSample sample;
    advance(run.model, run.integrator, now(run), NEVER, {}, sample.room(run.model.train));
    return sample;
}

// Mean loss of tooth friction [W] in the last step.
double mean_loss(const Exported& scene, RunState& run, double duration) {
    pop_mesh_sums(run.model, run.integrator, now(run), run.window_end.sums);
    double lost = 0.0;
    for (std::int64_t i = 0; i < scene.report.meshes; ++i)
        lost += run.window_end.sums.integral[POWER_LOSS][scene.report.mesh[i]];
    return lost / duration;
}

// Add the damage of the last step.
void add_damage(RunState& run) {
    for (int row = 0; row < DAMAGES; ++row)
        for (int i = 0; i < MESHES; ++i) {
            double& sum = run.damage.sum[row][i];
            const double before = sum, term = run.window_end.sums.damage[row][i];
            sum += term;
            run.damage.rounded_off[row][i] +=
                before >= term ? (before - sum) + term : (term - sum) + before;
        }
}

// Restart the sums of the meshes and the ledger.
void restart_sums(RunState& run) {
    pop_mesh_sums(run.model, run.integrator, now(run), run.window_end.sums);
    begin_window(run.model, run.integrator, now(run), run.window_end);
    sample_now(run);
}

}  // namespace

void prepare(const Exported& scene, RunState& run) {
    run = std::move(*std::make_unique<RunState>());  // which is too large for some stacks
    run.model = scene.model;
    run.integrator.control = scene.control;
    run.integrator.periodic.pause = scene.pause;
    run.point = run.wanted = scene.point;
    run.command = NO_COMMAND;
    run.tolerance = scene.tolerance;
}

void start(const Exported& scene, RunState& run) {
    const RunInputs inputs = run;
    prepare(scene, run);
    static_cast<RunInputs&>(run) = inputs;
    begin_temperatures(scene, run);
    load_point(scene, run);
    Integrator& integrator = run.integrator;
    double speed[AXES] = {start_speed(scene.laws, run.point), run.point.second_input_speed};
    const double force = mesh_force(scene.laws, run.model.operation.torque[0]);
    integrator.end = initial_state(run.model, speed, force).state;
    integrator.begin = integrator.end;
    begin_step(run.model, integrator);
    integrator.end = integrator.begin;  // tooth pairs may have started to stick
    sample_now(run);
    stored(run.model, integrator.end, integrator.scratch);
    pop_mesh_sums(run.model, integrator, now(run), run.window_end.sums);
    cut(run.model, integrator, now(run));
    begin_window(run.model, integrator, now(run), run.window_end);
    sample_now(run);
    read_ports(run.model, integrator, now(run), run.shown);
    run.started = true;
}

void change_point(const Exported& scene, RunState& run) {
    if (run.wanted == run.point) return;
    if (run.stepped) restart_sums(run);
    cut(run.model, run.integrator, now(run));
    run.integrator.sums.total = {};
    run.integrator.sums.taken = run.integrator.control.step;
    if (warms(scene) && run.wanted.ambient_temperature != run.network.ambient) {
        take_heat(run);
        run.network.ambient = run.wanted.ambient_temperature;
    }
    load_point(scene, run);
    begin_window(run.model, run.integrator, now(run), run.window_end);
    sample_now(run);
    run.stepped = false;
}

Outcome make_step(const Exported& scene, RunState& run, std::int64_t end) {
    const double duration = seconds_of(end - run.ticks);
    PortStep step{run.ticks, end, run.command, scene.linear, true};
    if (check(run.model.operation, scene.ranges, step.command) != Answer::ACCEPTED)
        return Outcome::REFUSED;
    run.command = NO_COMMAND;
    const Outcome outcome =
        step_ports(run.model, run.integrator, step, scene.limits, run.window_end, run.shown);
    run.ticks = end;
    run.stepped = true;
    if (outcome != Outcome::WITHIN_LIMITS) return outcome;
    run.tooth_loss = mean_loss(scene, run, duration);
    add_damage(run);
    const std::int64_t period = scene.warming.period;
    if (warms(scene) && end / period > run.heated / period) take_heat(run);
    return outcome;
}

double damage_of_part(const Exported& scene, const RunState& run, std::int64_t part) {
    double damage = 0.0;
    for (int row = 0; row < DAMAGES; ++row)
        for (int i = 0; i < MESHES; ++i)
            damage += scene.of_part[part][row][i] *
                      (run.damage.sum[row][i] + run.damage.rounded_off[row][i]);
    return damage;
}

int node_out_of_range(const Exported& scene, const RunState& run) {
    const double* temperature = run.network.temperature;
    int node = 0;
    while (node < NODES && scene.warming.lowest <= temperature[node] &&
           temperature[node] <= scene.warming.highest)
        ++node;
    return node;
}

void show_meshes(const Exported& scene, RunState& run, MeshesShown& out) {
    const Train& train = run.model.train;
    const OneSample sample = sample_now(run);
    double lost = 0.0;
    for (std::int64_t i = 0; i < scene.report.meshes; ++i) {
        for (int q = 0; q < QUANTITIES; ++q)
            out.mesh[q][i] = sample.mesh[q * train.meshes + scene.report.mesh[i]];
        lost += out.mesh[POWER_LOSS][i];
    }
    out.power_loss = sample.drag[0] + sample.drag[1] + (run.ticks ? run.tooth_loss : lost);
}

}  // namespace gearbox
