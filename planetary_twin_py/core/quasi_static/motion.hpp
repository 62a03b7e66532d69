#pragma once

// Rigid motion: every motor at its set-point, every body by the tooth numbers.

#include "model/model.hpp"
#include "model/state.hpp"
#include "run/clock.hpp"

namespace gearbox {

// Set frame, speeds and clock of `state` to those `after` seconds after `origin`, which may be
// `state` itself. Set-points approach their targets at the slew rate.
void advance_shafts(const Model& model, const State& origin, double after, State& state);

// Move `origin` to the last whole second before `until`, second by second. Turns are counted there,
// so that angles stay exact and do not depend on the times of the calls.
void advance_origin(const Model& model, State& origin, const Instant& until);

}  // namespace gearbox
