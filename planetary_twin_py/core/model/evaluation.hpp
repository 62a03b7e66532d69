#pragma once

#include "capacities.hpp"
#include "lubrication/mesh_friction.hpp"
#include "lubrication/tooth_pairs.hpp"
#include "mesh/meshes_now.hpp"

namespace gearbox {

struct alignas(64) Evaluation {
    alignas(64) double force[BODIES];           // [N]
    alignas(64) double friction_force[BODIES];  // friction and drag alone [N]
    alignas(64) double power[LEDGER];           // integrands of the energy ledger [W]
    MeshesNow now;
    ToothPairs pairs;
    MeshFriction friction;
};

}  // namespace gearbox
