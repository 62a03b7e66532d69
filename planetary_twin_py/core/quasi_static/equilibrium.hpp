#pragma once

// Static equilibrium of the train at one instant: torques, tooth forces, friction and drag.
//
// The motors keep their speeds, so along each rigid motion the load (and the second motor of a
// differential) gives what friction, drag and the inertia of a changing speed leave to be given.
// Tooth forces are those of bodies at rest in the frame that turns with the motors; where axes
// move, forces of bearings, too. Friction depends on them and they on friction, by some hundredths:
// a few passes bring both together. All laws are those of the dynamic model, applied to a state
// whose x squeezes every mesh by its static force.

#include <algorithm>
#include <iterator>

#include "capacities.hpp"
#include "quasi_static/equilibrium_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Columns of Equilibrium::play: the side whose flank carries.
constexpr int DRIVE_CLEARANCE = 0, COAST_CLEARANCE = 1;

// Where passes do not end: friction of a mesh that hardly touches counts as settled below this [N].
constexpr double NEGLIGIBLE_FORCE = 0.05;

// An equilibrium still to be found, the teeth on the side `lean`.
inline Equilibrium first_guess(std::int64_t closing_side) {
    Equilibrium run{};
    std::fill(std::begin(run.closing_side), std::end(run.closing_side), closing_side);
    return run;
}

// Bring `run`, whose frame stands where it is to be, into equilibrium; fill `shown`.
//
// model: the train, without mesh damping.
// tolerance: error of mesh forces relative to their mean.
// run: what it holds is the first guess.
// shown: (QUANTITIES, MESHES), see `observe`.
//
// Throws std::invalid_argument: there is no equilibrium, or it is not found.
void solve_equilibrium(const Model& model, double tolerance, Equilibrium& run,
                       double (*shown)[MESHES]);

}  // namespace gearbox
