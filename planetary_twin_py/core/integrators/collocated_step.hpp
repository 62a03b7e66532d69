#pragma once

// A step by collocation: how long it is, and where it ends. It ends exactly on the edge of a tooth
// pair, or where a flank meets or parts: its motion is known at any time within it.

#include "integrators/edges.hpp"
#include "integrators/integrator_record.hpp"
#include "train/model.hpp"

namespace gearbox {

// Let the step of collocation end after h seconds, on its own motion.
void end_within(const Model& model, Integrator& integrator, double h);

// A step by collocation of at most `longest` seconds, at whose end the mesh of `event` may come to
// an edge. The mesh whose flanks meet or part at its end, NO_MESH, or FAILED.
std::int64_t collocated_step(const Model& model, Integrator& integrator, double longest,
                             const NextEvent& event);

}  // namespace gearbox
