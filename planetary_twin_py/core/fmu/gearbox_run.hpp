#pragma once

// A run of an exported scene: its start, its steps, and changes of the operating point. It makes
// the same steps as `planetary_twin_py.Twin`.

#include <cstdint>

#include "fmu/exported.hpp"

namespace gearbox {

// What the importer sets.
struct RunInputs {
    OperatingPoint wanted;  // operating point from the next step on
    Command command;        // of the next step; NaN: no value is given
    double origin;          // time at the start [s]
    double tolerance;
};

// Damage of the meshes: sums of small terms, and what they have rounded off (Neumaier 1974).
struct MeshDamage {
    alignas(64) double sum[DAMAGES][MESHES];
    alignas(64) double rounded_off[DAMAGES][MESHES];
};

// State of a run.
struct alignas(64) RunState : RunInputs {
    Model model;
    Integrator integrator;
    OperatingPoint point;  // present operating point
    PortStates shown;
    WindowEnd window_end;
    Network network;      // temperatures, where they are states
    MeshDamage damage;    // since the start
    std::int64_t ticks;   // since the start
    std::int64_t heated;  // instant up to which heat is taken [ticks]
    double tooth_loss;    // loss of tooth friction, mean of the last step [W]
    bool running;         // the initialisation is complete
    bool dirty;           // values have been set that are not applied yet
    bool started;
    bool stepped;  // since the operating point changed
    bool failed;   // no further step is possible
};

// The state before a run starts.
void prepare(const Exported& scene, RunState& run);

// Start the run in steady running at the wanted operating point. Throws NoFiniteState.
void start(const Exported& scene, RunState& run);

// Apply the wanted operating point from now on. Throws NoFiniteState.
void change_point(const Exported& scene, RunState& run);

// Simulate until `end` [ticks] under the command.
Outcome make_step(const Exported& scene, RunState& run, std::int64_t end);

// Present quantities of the meshes.
struct MeshesShown {
    double mesh[QUANTITIES][MESHES];
    double power_loss;  // present loss of bearings and churning, mean loss of teeth in the step [W]
};

// Miner sum of a part [-], of gears the mean over their teeth.
double damage_of_part(const Exported& scene, const RunState& run, std::int64_t part);

// The first node outside the range of temperatures; NODES if there is none.
int node_out_of_range(const Exported& scene, const RunState& run);

void show_meshes(const Exported& scene, RunState& run, MeshesShown& out);

}  // namespace gearbox
