#pragma once

// A run of an exported scene: its start, its steps, and changes of the operating point. It makes
// the same steps as `planetary_twin_py.Twin`.

#include <cstdint>

#include "fmu/exported.hpp"

namespace gearbox {

// All that changes in a run.
struct alignas(64) RunState {
    Model model;
    March march;
    OperatingPoint point;   // that acts
    OperatingPoint wanted;  // from the next step on
    Command command;        // of the next step; NaN: nothing is given
    PortStates shown;
    WindowEnd books;
    std::int64_t ticks;  // since the start
    double origin;       // time at the start [s]
    double tolerance;
    double tooth_loss;  // of tooth friction, mean of the last step [W]
    bool running;       // the initialisation is over
    bool dirty;         // what has been set has had no effect yet
    bool started;
    bool stepped;  // since the operating point changed
    bool failed;   // no step leads on
};

// The state before a run starts.
void prepare(const Exported& scene, RunState& run);

// Put the run at its start, in steady running at the operating point that is wanted. Throws
// NoFiniteState.
void start(const Exported& scene, RunState& run);

// Let the operating point that is wanted act from now on. Throws NoFiniteState.
void change_point(const Exported& scene, RunState& run);

// Simulate until `end` [ticks] under the command.
Outcome make_step(const Exported& scene, RunState& run, std::int64_t end);

// What the meshes show now.
struct MeshesShown {
    double mesh[QUANTITIES][MESHES];
    double power_loss;  // of bearings and churning now, and of tooth friction in the step [W]
};

void show_meshes(const Exported& scene, RunState& run, MeshesShown& out);

}  // namespace gearbox
