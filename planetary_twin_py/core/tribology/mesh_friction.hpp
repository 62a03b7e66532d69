#pragma once

// Friction of all meshes at several instants of a step side by side.
//
// The tooth pairs of all instants stand in columns. The laws run over them part by part: while one
// register waits for a result, the others are computed. In single precision a register holds twice
// as many, and friction errs by a millionth.

#include "mesh/meshes_now.hpp"
#include "train/model.hpp"
#include "train/step_constants.hpp"
#include "tribology/tooth_pairs.hpp"

namespace gearbox {

inline constexpr int MOST_INSTANTS = 5;

// Sums over the tooth pairs of each mesh.
struct alignas(64) MeshFriction {
    DragOfMeshes drag;
    alignas(64) double lost[MESHES];      // to friction and rolling resistance [W]
    alignas(64) double boundary[MESHES];  // [N]
    alignas(64) double viscous[MESHES];   // [N]
    alignas(64) double film[MESHES];      // mean by the load [m]
};

// An instant: positions of the meshes, the speeds of their gears [rad/s] relative to the carrier,
// and where axes move relative to their lines of action, with work space for the results.
struct FrictionInstant {
    const MeshesNow* meshes;
    const double (*spin)[MESHES];
    MeshFriction* found;
};

// Fill the results at so many instants, at most MOST_INSTANTS. Entries beyond the meshes are
// zero.
void find_friction(const Model& model, const StepConstants& step, const FrictionInstant* instants,
                   int count, bool single_precision);

}  // namespace gearbox
