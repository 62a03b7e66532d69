#include "quasi_static/totals.hpp"

#include <cmath>

namespace gearbox {

const double GAUSS_NODES[PANEL_NODES] = {-0.8611363115940526, -0.33998104358485626,
                                         0.33998104358485626, 0.8611363115940526};
const double GAUSS_WEIGHTS[PANEL_NODES] = {0.34785484513745357, 0.6521451548625464,
                                           0.6521451548625464, 0.34785484513745357};

namespace {

// Values at both ends of a panel from those at its nodes by Lagrange polynomials.
constexpr double ENDS[2][PANEL_NODES] = {
    {1.5267881254572664, -0.813632449486927, 0.40076152031165035, -0.11391719628198993},
    {-0.11391719628198993, 0.40076152031165035, -0.813632449486927, 1.5267881254572662}};

// The larger of two numbers, or NaN.
double raise(double peak, double value) {
    return value <= peak ? peak : value;
}

void raise_peak(double value, int row, int n, std::int64_t i, double (*peak)[MESHES]) {
    peak[row][i] = raise(peak[row][i], std::abs(value));
    for (int end = 0; end < 2; ++end) {
        double& room = peak[2 + 2 * row + end][i];
        room = (n == 0 ? 0.0 : room) + ENDS[end][n] * value;
    }
}

}  // namespace

void add_rates(const Train& train, const double* power, const double (*shown)[MESHES],
               double weight, double* out) {
    for (int e = 0; e < LEDGER; ++e) out[e] += weight * power[e];
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        double* sums = out + LEDGER + i;
        auto value = [&](int q) { return shown[q][i]; };
        for (int q = 0; q < QUANTITIES; ++q)
            if (!std::isnan(value(q))) sums[q * MESHES] += weight * value(q);
        bool touching = value(MESH_FORCE) != 0.0;
        sums[SQUARE * MESHES] += weight * value(DTE) * value(DTE);
        sums[CONTACT * MESHES] += touching ? weight : 0.0;
        sums[CLIPPED * MESHES] += touching && value(VISCOUS) == 0.0 ? weight : 0.0;
        sums[FILMED * MESHES] += std::isnan(value(FILM)) ? 0.0 : weight;
    }
    out[TOTALS - 1] += weight;
}

void raise_peaks_at_node(const Train& train, const double (*shown)[MESHES], int n,
                         double (*peak)[MESHES]) {
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        raise_peak(shown[DTE][i], DTE_PEAK, n, i, peak);
        raise_peak(shown[MESH_FORCE][i], FORCE_PEAK, n, i, peak);
    }
}

void raise_peaks_at_ends(const Train& train, double (*peak)[MESHES]) {
    for (std::int64_t i = 0; i < train.meshes; ++i)
        for (int row = 0; row < 2; ++row)
            for (int end = 0; end < 2; ++end)
                peak[row][i] = raise(peak[row][i], std::abs(peak[2 + 2 * row + end][i]));
}

}  // namespace gearbox
