#pragma once

// Static equilibrium of the train at one instant: torques, tooth forces, friction and drag.
//
// The motors keep their speeds, so along each rigid motion the load (and the second motor of a
// differential) balances the other torques, friction, drag and the inertia of a changing speed.
// Tooth forces are those of bodies at rest in the frame that turns with the motors; where axes
// move, forces of bearings, too. Friction depends on the forces, and the forces, by some per cent,
// on friction: a few passes suffice. All laws are those of the dynamic model, in a state whose x
// compresses every mesh by its static force.

#include <algorithm>
#include <iterator>

#include "capacities.hpp"
#include "model/model.hpp"
#include "quasi_static/equilibrium_record.hpp"

namespace gearbox {

// Columns of Equilibrium::clearance: the side whose flank carries.
constexpr int DRIVE_CLEARANCE = 0, COAST_CLEARANCE = 1;

// If passes do not converge: changes of friction below this count as converged [N].
constexpr double NEGLIGIBLE_FORCE = 0.05;

// Initial guess of an equilibrium; open meshes close on `closing_side`.
inline Equilibrium first_guess(std::int64_t closing_side) {
    Equilibrium run{};
    std::fill(std::begin(run.closing_side), std::end(run.closing_side), closing_side);
    return run;
}

// Find the equilibrium of `run` at the position of its frame; fill `shown`.
//
// model: the train, without mesh damping. tolerance: error of mesh forces relative to their mean.
// run: its values are the initial guess. shown: (QUANTITIES, MESHES), see `observe`.
//
// Throws std::invalid_argument if there is no equilibrium, or it is not found.
void solve_equilibrium(const Model& model, double tolerance, Equilibrium& run,
                       double (*shown)[MESHES]);

}  // namespace gearbox
