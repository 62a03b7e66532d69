#pragma once

// Drive the one-step methods from event to event and sample what lies between.
//
// Events are tooth pairs entering or leaving, flanks meeting or parting, and the speed set-point
// reaching its target. Steps end on them, so the equations are smooth within every step. Windows do
// not cut steps: samples come from the interpolant of the step, and the last step ends at or after
// the end of the window. So the path does not depend on the windows.
//
// Steps are collocation steps. Where collocation does not converge, Rosenbrock's method takes over
// for a while. Where mesh cycles repeat, the last cycle is repeated, and no steps are computed.

#include "integrators/integrator_record.hpp"
#include "run/clock.hpp"
#include "run/samples.hpp"
#include "train/model.hpp"

namespace gearbox {

// Start a new step where the last one ended.
void begin_step(const Model& model, Integrator& integrator);

// One accepted step of at most `longest` seconds from `begin`, ending on the first event. Throws
// NoFiniteState.
void one_step(const Model& model, Integrator& integrator, double longest);

// Let the step stand; `mesh` changes its contact at its end (NO_MESH: none).
void accept(const Model& model, Integrator& integrator, std::int64_t mesh);

// Integrate to `until`, and fill `out` with `samples`, none of them later. No step that is made
// passes `bound`. Throws NoFiniteState.
void advance(const Model& model, Integrator& integrator, const Instant& until, const Instant& bound,
             Sampling samples, const Samples& out);

// The same, and fill `last` with the sample at `until`.
void advance(const Model& model, Integrator& integrator, const Instant& until, const Instant& bound,
             const Sampling& samples, const Samples& out, const Samples& last);

// Let the last step end at `until`, which is within it, on its own motion: what is given at the
// ports changes there. Other than `cut`, this makes no step again. Throws NoFiniteState.
void interrupt(const Model& model, Integrator& integrator, const Instant& until);

// Take back what lies beyond `until`, which is within the last step: what changes from outside,
// changes there, and the next step begins at it. Throws NoFiniteState.
void cut(const Model& model, Integrator& integrator, const Instant& until);

}  // namespace gearbox
