#pragma once

#include <cstdint>

#include "capacities.hpp"

namespace gearbox {

// The report of a train: every body and mesh of the gearset, in the order of their names.
struct Report {
    std::int64_t bodies;
    std::int64_t body[BODIES];             // its place in the train; the ground is after the last
    std::int64_t numerator[BODIES][AXES];  // turns per whole turn of each motor, as a fraction
    std::int64_t denominator[BODIES];      // of the turns of both
    std::int64_t meshes;
    std::int64_t mesh[MESHES];  // its place in the train
};

}  // namespace gearbox
