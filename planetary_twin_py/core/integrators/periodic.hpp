#pragma once

// Steady running: mesh cycles that repeat are not computed again.
//
// A cycle is replayed until an input changes, if states one cycle apart have agreed to a fraction
// of the tolerance for long enough, and if the motion is stable: a run that starts beside it joins
// it, see `neighbour.hpp`. Agreement alone does not suffice, because motion leaves an unstable
// cycle as slowly as it comes near one. Dense output treats replayed steps like computed ones.
//
// The duration of the cycle follows from the speed set-point: the speed loop prevents drift.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"
#include "run/clock.hpp"

namespace gearbox {

// Check whether the last step ends at an earlier state of the train.
void check_periodicity(const Model& model, Integrator& integrator);

// Restart the detection of steady running after a change of the inputs.
void restart_settling(Integrator& integrator);

// End the last step at `now` with `cut`, for a small change of the oil from there on.
void cut_for_oil(const Model& model, Integrator& integrator, const Instant& now);

// Losses of a ledger [J], or a power of it [W].
double losses_of(const double* energy);

// The step that was replayed last, or that closed the cycle.
CycleStep& replayed_step(Periodic& periodic);

// Advance to the next step, of the next cycle after the last one; nothing is summed up.
CycleStep& following_step(Periodic& periodic);

// Add the sums of a replayed step to those of the window.
void add_replayed(const Train& train, const CycleStep& step, Integrator& integrator);

// Advance to the step of the cycle that ends at or after `until`; earlier steps are summed up.
CycleStep& next_step(const Model& model, Integrator& integrator, const Instant& until);

// Set the motion to that of a step of the cycle, for samples.
void stand_at(const Model& model, Integrator& integrator, const CycleStep& step);

// Set the integrator to its state after a step of the cycle.
void continue_from(const Model& model, Integrator& integrator, const CycleStep& step);

// Turns of the motor.
struct Turns {
    double whole;
    double fraction;  // in [0, 1)
};

// Turns of the motor at a place in the present cycle.
Turns turns_at(const Periodic& periodic, const Place& place);

}  // namespace gearbox
