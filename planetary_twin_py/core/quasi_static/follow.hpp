#pragma once

// Damage of a quasi-static run: passages of tooth pairs, followed through the panels of its
// quadrature.

#include "mesh/mesh_sums.hpp"
#include "model/passages_record.hpp"
#include "quasi_static/quadrature.hpp"

namespace gearbox {

// Follow the passages from `state`, which moves, to `until`; the damage adds to `sums`.
//
// Peaks are sought at the nodes of every panel and close to its ends.
void follow_passages(const EquilibriumSolver& solver, State& state, std::span<const double> edges,
                     const Instant& until, Passages& passages, MeshSums& sums);

}  // namespace gearbox
