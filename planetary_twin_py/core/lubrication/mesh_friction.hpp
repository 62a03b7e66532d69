#pragma once

// Friction of all meshes at several instants of a step in parallel.
//
// The tooth pairs of all instants form columns. The laws are evaluated part by part for all
// registers, which hides latencies. In single precision a register has twice as many numbers, and
// the relative error of friction is about 1e-6.

#include "lubrication/tooth_pairs.hpp"
#include "mesh/meshes_now.hpp"
#include "model/model.hpp"
#include "model/step_constants.hpp"

namespace gearbox {

inline constexpr int MOST_INSTANTS = 5;

// Sums over the tooth pairs of each mesh.
struct alignas(64) MeshFriction {
    DragOfMeshes drag;
    alignas(64) double lost[MESHES];      // to friction and rolling resistance [W]
    alignas(64) double boundary[MESHES];  // [N]
    alignas(64) double viscous[MESHES];   // [N]
    alignas(64) double film[MESHES];      // mean weighted by load [m]
    // Where damage is counted, of the loaded pairs: highest flash temperature [K], one over the
    // thinnest film [1/m]; 0 if there is none.
    alignas(64) double flash[MESHES];
    alignas(64) double per_film[MESHES];
};

// An instant: positions of the meshes, the speeds of their gears [rad/s] relative to the carrier,
// and where axes move relative to their lines of action, with work space for the results.
struct FrictionInstant {
    const MeshesNow* meshes;
    const double (*spin)[MESHES];
    MeshFriction* found;
};

// Fill the results at several instants, at most MOST_INSTANTS. Entries beyond the meshes are zero.
void find_friction(const Model& model, const StepConstants& step, const FrictionInstant* instants,
                   int count, bool single_precision);

}  // namespace gearbox
