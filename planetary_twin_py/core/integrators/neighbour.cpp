#include "integrators/neighbour.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "integrators/distance.hpp"
#include "integrators/integrator.hpp"
#include "integrators/methods.hpp"

namespace gearbox {

namespace {

// Deflection of the meshes of the same energy as the change of the speed of a body [tolerances].
constexpr double KICK = 3.0;
constexpr double APART = std::numeric_limits<double>::infinity();

// A different number for each body, of either sign and between a half and one, so that no mode of
// equal planets is left out.
double share_of(std::int64_t body) {
    const double part = static_cast<double>(body + 1) * std::numbers::phi;
    const double magnitude = 1.0 - 0.5 * (part - std::floor(part));
    return std::popcount(static_cast<std::uint64_t>(body)) % 2 == 0 ? magnitude : -magnitude;
}

// Change the speeds by about equal energies of all bodies, and so of all modes, but not the speed
// of the train as a whole: the speed loop controls it, and is stable by itself.
void kick(const Train& train, double speed, State& state) {
    const double lightest = *std::min_element(train.body.mass, train.body.mass + train.bodies);
    auto own = [&](std::int64_t j) {
        return share_of(j) * std::sqrt(lightest / train.body.mass[j]);
    };
    auto rigid = [&](std::int64_t j) { return train.body.ratio[0][j] * train.body.radius[j]; };
    double momentum = 0.0, inertia = 0.0;
    for (std::int64_t j = 0; j < train.bodies; ++j) {
        momentum += rigid(j) * train.body.mass[j] * own(j);
        inertia += rigid(j) * train.body.mass[j] * rigid(j);
    }
    for (std::int64_t j = 0; j < train.bodies; ++j)
        state.v[j] += speed * (own(j) - rigid(j) * momentum / inertia);
}

// All that later steps depend on.
void copy_run(const Integrator& source, Integrator& target) {
    target.begin = source.begin;
    target.end = source.end;
    target.constants = source.constants;
    target.scratch = source.scratch;
    target.first = source.first;
    target.last = source.last;
    target.control = source.control;
    target.run = source.run;
    target.sums.not_requested = true;
}

bool complete_period(const Model& model, Integrator& run, std::int64_t cycles) {
    for (int k = 0; k < MOST_CYCLE_STEPS; ++k) {
        begin_step(model, run);
        one_step(model, run, APART);
        if (begins_mesh_cycle(run) && --cycles == 0) return true;
    }
    return false;
}

}  // namespace

void start_neighbour(const Model& model, Integrator& integrator) {
    const Control& control = integrator.control;
    const double change = KICK * control.tolerance * control.deflection;
    Integrator& run = integrator.periodic.neighbour.emplace_back();
    copy_run(integrator, run);
    kick(model.train, change * control.speed_per_deflection, run.end);
    run.control.changed = true;
}

double follow_neighbour(const Model& model, Integrator& integrator) {
    Integrator& run = integrator.periodic.neighbour.front();
    try {
        if (!complete_period(model, run, integrator.periodic.cycles)) {
            integrator.periodic.cycles = 0;  // too many steps to be stored
            return APART;
        }
    } catch (const NoFiniteState&) {
        return APART;
    }
    return distance(model, integrator.control, run.end, integrator.end);
}

}  // namespace gearbox
