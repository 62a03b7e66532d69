#pragma once

// A step of Rosenbrock's method: its length and its end. Near standstill friction is too stiff for
// the sweeps of collocation to converge, and damping too strong for its accuracy.

#include "integrators/integrator_record.hpp"
#include "model/model.hpp"

namespace gearbox {

// A step of Rosenbrock's method of at most `longest` seconds; the mesh whose contact changes at its
// end, or NO_MESH. Throws NoFiniteState.
std::int64_t stiff_step(const Model& model, Integrator& integrator, double longest, double event);

}  // namespace gearbox
