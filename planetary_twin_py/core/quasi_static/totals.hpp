#pragma once

// Totals of a quasi-static run: the energy ledger, and integrals and extremes of its meshes.

#include "capacities.hpp"
#include "model/train.hpp"

namespace gearbox {

// Entries of the totals, one after the other: the ledger, integrals of the meshes (SUMS, MESHES),
// and the time.
constexpr int TOTALS = LEDGER + SUMS * MESHES + 1;
// Rows of the peaks: largest magnitudes of transmission error and force, and work space for them at
// both ends of a panel.
constexpr int DTE_PEAK = 0, FORCE_PEAK = 1, PEAKS = 6;

// Gauss-Legendre rule on a panel from -1 to 1.
constexpr int PANEL_NODES = 4;
extern const double GAUSS_NODES[PANEL_NODES];
extern const double GAUSS_WEIGHTS[PANEL_NODES];

// Add the rates at one instant, times `weight` [s], to the totals `out`.
//
// power: of the ledger (LEDGER,). shown: quantities of the meshes (QUANTITIES, MESHES), see
// `observe`.
void add_rates(const Train& train, const double* power, const double (*shown)[MESHES],
               double weight, double* out);

// Update `peak` with the quantities at node n of a panel, from 0.
void raise_peaks_at_node(const Train& train, const double (*shown)[MESHES], int n,
                         double (*peak)[MESHES]);

// Update `peak` with the ends of the panel, extrapolated from its nodes.
void raise_peaks_at_ends(const Train& train, double (*peak)[MESHES]);

}  // namespace gearbox
