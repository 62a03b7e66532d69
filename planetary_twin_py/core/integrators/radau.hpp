#pragma once

// Radau's points: nodes of the quadrature of order 2 s - 1 that has the end among them.

#include "integrators/nodes.hpp"

namespace gearbox {

// Fill the nodes of so many points, at most MOST_NODES.
void radau(int points, Nodes& nodes);

}  // namespace gearbox
