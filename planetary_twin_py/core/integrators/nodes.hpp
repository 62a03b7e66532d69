#pragma once

#include <cstdint>

#include "integrators/parabola.hpp"

namespace gearbox {

// Radau points: nodes of the quadrature of order 2 s - 1 that contains the end.
struct alignas(64) Nodes {
    std::int64_t count;
    double abscissa[5];                    // in (0, 1], the last of which is 1
    alignas(64) double coefficient[5][5];  // of the powers of t (rows) from the values (columns)
    alignas(64) double legendre[5][5];     // of Legendre polynomials (rows), likewise
    alignas(64) double integral[5][8];     // of the powers of t from t^1 in the integral up to t
    Neighbours neighbours[5];  // of each node but the last; before the first is the start
    double widest;             // distance of two neighbours; before the first is the start
    double smallest;           // bound on the product of the distances of t from all points
};

// Fill the nodes for a number of points, at most MOST_NODES.
void radau(int points, Nodes& nodes);

}  // namespace gearbox
