#pragma once

#include "capacities.hpp"
#include "lubrication/mesh_friction.hpp"
#include "mesh/meshes_now.hpp"

namespace gearbox {

// A collocation point: motion of the train, and forces on it.
struct alignas(64) Node {
    alignas(64) double q[BODIES];  // modes
    alignas(64) double p[BODIES];
    alignas(64) double x[BODIES];  // bodies [m], [m/s]
    alignas(64) double v[BODIES];
    double trim[AXES];                           // of the speed loops [rad]
    alignas(64) double d[MESHES];                // transmission errors [m], [m/s]
    alignas(64) double rate[MESHES];             // of the transmission errors [m/s]
    alignas(64) double spin[GEARS - 1][MESHES];  // of both gears against the carrier [rad/s]
    alignas(64) double friction_force[BODIES];   // friction and drag, in the modes
    alignas(64) double power[LEDGER];            // without losses and work of the meshes [W]
    MeshesNow meshes;
    MeshFriction friction;
};

}  // namespace gearbox
