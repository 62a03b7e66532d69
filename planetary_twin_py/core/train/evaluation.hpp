#pragma once

#include <cstdint>

#include "mesh/meshes_now.hpp"
#include "tribology/tooth_pairs.hpp"

namespace gearbox {

struct alignas(64) Evaluation {
    alignas(64) double force[16];  // [N]
    alignas(64) double rubbing[16];  // friction and drag alone [N]
    alignas(64) double power[11];  // integrands of the energy ledger [W]
    MeshesNow now;
    ToothPairs pairs;
    DragOfMeshes dragging;
};

}  // namespace gearbox
