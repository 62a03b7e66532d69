#pragma once

// Undamped modes of the train for each contact state: the meshes in contact and their stiffness.
//
// Between two contact events the train is nearly linear: M x'' + C x' + K x = r, with a nonlinear
// remainder r. In the modes of K the left side decouples into oscillators q'' + c q' + w^2 q, whose
// motion is known exactly for any step. The modes of each contact state are stored, because the
// same states occur in every mesh cycle.

#include "integrators/contact_modes_record.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace gearbox {

inline constexpr std::int64_t CONTACT_STATES = MOVING ? 512 : 1024;  // largest number stored

// Key of the contacts of `state` and of the shafts with a given motion.
ContactKey contact_key(const Model& model, const State& state);

// Index in `known` of the modes of the contact state, which are computed once. In these modes, the
// end of a shaft with a given motion is fixed.
std::int64_t find_modes(const Model& model, const State& state, ContactModes& known);

}  // namespace gearbox
