#pragma once

// A step by Rosenbrock's method: how long it is, and where it ends. Near standstill friction is too
// stiff for the sweeps of collocation to come to rest, and damping too strong for its digits.

#include "integrators/integrator_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// A step by Rosenbrock's method of at most `longest` seconds; the mesh whose flanks meet or part at
// its end, or NO_MESH. Throws NoFiniteState.
std::int64_t stiff_step(const Model& model, Integrator& integrator, double longest, double event);

}  // namespace gearbox
