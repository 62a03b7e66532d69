#pragma once

// Steady running: mesh cycles that come back to where they began are not computed again.
//
// Once all that the train depends on has come round, so that it stands where it stood to a small
// share of the tolerance, and has done so for longer than anything in it takes to settle, its last
// cycle is kept and repeats until something acts on the train from outside. Dense output reads a
// repeated step as it reads a computed one.
//
// The cycle lasts as long as the speed set-point takes for it: the speed loop would not let it
// drift.

#include "integrators/integrator_record.hpp"
#include "run/clock.hpp"
#include "train/model.hpp"

namespace gearbox {

// Check whether the step just made ends where the train has been before.
void check_periodicity(const Model& model, Integrator& integrator);

// Something acts on the train from outside: it must settle again.
void restart_settling(Integrator& integrator);

// The step that was played last, or that closed the cycle.
CycleStep& replayed_step(Periodic& periodic);

// Go on to the step of the cycle that ends at or after `until`; those before it are summed up.
CycleStep& next_step(const Model& model, Integrator& integrator, const Instant& until);

// Let the march be as if it had just made a step of the cycle.
void continue_from(const Model& model, Integrator& integrator, const CycleStep& step);

// Turns of the motor.
struct Turns {
    double whole;
    double fraction;  // in [0, 1)
};

// Those at a place in the present cycle.
Turns turns_at(const Periodic& periodic, const Place& place);

}  // namespace gearbox
