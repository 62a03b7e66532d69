#pragma once

// Integrates with one-step methods from event to event, and samples the steps.
//
// Events are tooth pairs that enter or leave, flanks that come into contact or separate, and speed
// set-points that reach their targets. Steps end at events, so the equations are smooth within
// every step. Windows do not cut steps: samples come from the interpolant of the step, and the last
// step ends at or after the end of the window. So the motion does not depend on the windows.
//
// Steps are collocation steps. Where collocation does not converge, some steps use Rosenbrock's
// method. Where mesh cycles repeat, the last cycle is replayed without computing steps.

#include <span>

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"
#include "run/clock.hpp"
#include "run/samples.hpp"

namespace gearbox {

// Start a new step where the last one ended.
void begin_step(const Model& model, Integrator& integrator);

// One accepted step of at most `longest` seconds from `begin`, ending on the first event. Throws
// NoFiniteState.
void one_step(const Model& model, Integrator& integrator, double longest);

// Accept the step; the contact of `mesh` changes at its end (NO_MESH: none).
void accept(const Model& model, Integrator& integrator, std::int64_t mesh);

// Integrate to `until`, and write the samples of `grids`, which are due by then. No step ends after
// `bound`. Throws NoFiniteState.
void advance(const Model& model, Integrator& integrator, const Instant& until, const Instant& bound,
             std::span<Grid> grids);

// The same, and fill `last` with the sample at `until`.
void advance(const Model& model, Integrator& integrator, const Instant& until, const Instant& bound,
             std::span<Grid> grids, const Samples& last);

// End the last step at `until`, a time within it, on its interpolant: given torques or motions
// change there. Unlike `cut`, this does not compute the step again. Throws NoFiniteState.
void interrupt(const Model& model, Integrator& integrator, const Instant& until);

// Shorten the last step to end at `until`, a time within it, where the operating point changes; the
// next step starts there. Throws NoFiniteState.
void cut(const Model& model, Integrator& integrator, const Instant& until);

}  // namespace gearbox
