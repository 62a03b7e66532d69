#pragma once

// A window of a run: its waveform, and the state of the train at its end.

#include <vector>

#include "integrators/integrator_record.hpp"
#include "mesh/mesh_sums.hpp"
#include "model/model.hpp"
#include "model/network.hpp"
#include "run/clock.hpp"
#include "run/limits.hpp"
#include "run/report.hpp"
#include "run/waveform.hpp"

namespace gearbox {

// State of the train at the end of a window, and the sums up to it.
//
// Within the step that contains the end, the powers of the ledger are taken as constant.
struct alignas(64) WindowEnd {
    double ledger[LEDGER];    // since the last reading; heat since the network took it
    double power[LEDGER];     // of the ledger, at the end of the last step
    double kinetic, elastic;  // energies [J]
    double turns[AXES];       // whole turns of the motors
    double angle[BODIES];     // in addition to these [rad]
    MeshSums sums;            // of the window
    Peaks peaks;              // of its samples
};

// The task: a window, or the first part of one.
struct WindowJob {
    const Model& model;
    Integrator& integrator;
    Instant until;
    const Limits& limits;
    const Report& report;
    std::vector<Waveform> out;  // independent of one another; `end` has the peaks of the first
    WindowEnd& end;
    bool closes;  // whether the window ends there
};

enum class Outcome { WITHIN_LIMITS, EXCEEDED, NOT_FINITE, REFUSED };

// Integrate to `until`; fill the waveforms, and turns, angles, peaks and power of `end`.
//
// If the window ends within the limits, ledger and sums are moved to `end`.
Outcome run_window(const WindowJob& job);

// Run all jobs, no two of which share an integrator, in threads; the outcomes in their order. Each
// run is computed by one thread independently of the others: the results are bitwise those of
// sequential runs.
std::vector<Outcome> run_windows(const std::vector<WindowJob>& jobs, int workers);

// Copy integrals and extremes of the meshes up to `until`, the end of the last window, and restart
// them.
void pop_mesh_sums(const Model& model, Integrator& integrator, const Instant& until,
                   MeshSums& sums);

// Continue with another train from `now` on, the end of the last window or a time within it: the
// energy that meshes and bearings gain at once is work of changing stiffness.
void change_train(Model& model, Integrator& integrator, const Instant& now, const Train& train);

// Let the network take the heat of the last `duration` seconds before `now`, the end of the last
// window or a time within it. If its temperatures have moved by the dead band, the last step ends
// there, and the run continues with oil at these temperatures: returns whether it does.
bool warm_up(Model& model, Integrator& integrator, Network& network, const Instant& now,
             double duration);

// Start a window at `now`, the end of the last one: fill ledger, power and stored energy of `end`.
void begin_window(const Model& model, Integrator& integrator, const Instant& now, WindowEnd& end);

// Extend `total`, the end of consecutive windows, by the next window.
void extend(const Train& train, const WindowEnd& next, WindowEnd& total);

}  // namespace gearbox
