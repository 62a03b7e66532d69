#pragma once

// Difference of two states of a train at the same place of its period.

#include "integrators/control.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace gearbox {

// Change of the transmission errors, in static deflections, by a delay of one mesh cycle.
inline constexpr double PHASE = 20.0;

// Whether all meshes touch at the same flanks and tooth pairs.
bool same_contacts(const Train& train, const State& a, const State& b);

// Difference of two states as a deflection of the meshes [tolerances]; infinite while a set-point
// slews.
double distance(const Model& model, const Control& control, const State& a, const State& b);

}  // namespace gearbox
