#pragma once

#include "integrators/integrator_record.hpp"

namespace gearbox {

// Whether a mesh cycle starts at the end of the step.
inline bool begins_mesh_cycle(const Integrator& integrator) {
    const State &begin = integrator.begin, &end = integrator.end;
    return begin.segment[0] != 0 && end.segment[0] == 0 && end.side[0] != OPEN;
}

}  // namespace gearbox
