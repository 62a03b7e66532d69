#pragma once

// Undamped modes of the train for the meshes that are in contact and the stiffness they have.
//
// Between two contact events the train is nearly linear: M x'' + C x' + K x = rest. In the modes of
// K the left side falls apart into oscillators q'' + c q' + w^2 q, whose motion is known exactly
// whatever the step. Each contact state has its modes; they are kept, because meshing returns to
// the same states in every cycle.

#include "integrators/contact_modes_record.hpp"
#include "train/model.hpp"
#include "train/state.hpp"

namespace gearbox {

inline constexpr std::int64_t CONTACT_STATES = MOVING ? 512 : 1024;  // kept at most

// Contacts of `state`, and which shafts have a motion that is given.
ContactKey contact_key(const Model& model, const State& state);

// Place in `known` of the modes of the contacts of `state`, which are computed once. In them, the
// end of a shaft whose motion is given stands still.
std::int64_t find_modes(const Model& model, const State& state, ContactModes& known);

}  // namespace gearbox
