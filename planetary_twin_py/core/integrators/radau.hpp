#pragma once

// Radau points: nodes of the quadrature of order 2 s - 1 that contains the end.

#include "integrators/nodes.hpp"

namespace gearbox {

// Fill the nodes for a number of points, at most MOST_NODES.
void radau(int points, Nodes& nodes);

}  // namespace gearbox
