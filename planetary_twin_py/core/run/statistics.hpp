#pragma once

// Mean, rms and peak values of the meshes over an interval, from its integrals for each mesh.

#include <cmath>
#include <cstdint>
#include <iterator>

#include "mesh/mesh_sums.hpp"

namespace gearbox {

constexpr double ROUNDING_OF_SUM = 1e-12;  // of the sum of the steps of an interval

// A fraction of time, without rounding errors near 0 and 1.
inline double fraction_of_time(double mean) {
    if (std::fabs(mean - 1.0) < ROUNDING_OF_SUM || mean > 1.0) return 1.0;
    return std::fabs(mean) < ROUNDING_OF_SUM || mean < 0.0 ? 0.0 : mean;
}

// The sums of mesh i.
struct SumsOfMesh {
    const MeshSums& sums;
    std::int64_t i;

    double mean(int row) const { return sums.integral[row][i] / sums.time; }

    // Mean over the time in which the film is known, NaN if there is no such time.
    double film_mean(int row) const { return mean(row) / mean(FILMED); }
};

struct MeshStatistic {
    const char* name;  // in `units/catalogue.py`
    double (*value)(const SumsOfMesh&);
};

constexpr MeshStatistic MESH_STATISTICS[] = {
    {"dte_mean", [](const SumsOfMesh& mesh) { return mesh.mean(DTE); }},
    {"dte_rms",  // of the deviation from the mean
     [](const SumsOfMesh& mesh) {
         double mean = mesh.mean(DTE), square = mesh.mean(SQUARE) - mean * mean;
         return std::sqrt(square < 0.0 ? 0.0 : square);
     }},
    {"dte_peak", [](const SumsOfMesh& mesh) { return mesh.sums.dte_peak[mesh.i]; }},
    {"mesh_force_mean", [](const SumsOfMesh& mesh) { return mesh.mean(MESH_FORCE); }},
    {"mesh_force_peak", [](const SumsOfMesh& mesh) { return mesh.sums.force_peak[mesh.i]; }},
    {"contact_fraction",
     [](const SumsOfMesh& mesh) { return fraction_of_time(mesh.mean(CONTACT)); }},
    {"without_viscous",  // in which teeth carry load without viscous friction
     [](const SumsOfMesh& mesh) { return fraction_of_time(mesh.mean(CLIPPED)); }},
    {"film_thickness", [](const SumsOfMesh& mesh) { return mesh.film_mean(FILM); }},
    {"lambda_ratio", [](const SumsOfMesh& mesh) { return mesh.film_mean(LAMBDA); }},
    {"boundary_friction", [](const SumsOfMesh& mesh) { return mesh.mean(BOUNDARY); }},
    {"viscous_friction", [](const SumsOfMesh& mesh) { return mesh.mean(VISCOUS); }},
    {"power_loss", [](const SumsOfMesh& mesh) { return mesh.mean(POWER_LOSS); }},
};
constexpr int STATISTICS = static_cast<int>(std::size(MESH_STATISTICS));

// Statistics of mesh i to out[n * room], in the order of MESH_STATISTICS.
inline void mesh_statistics(const MeshSums& sums, std::int64_t i, double* out, std::int64_t room) {
    for (const MeshStatistic& each : MESH_STATISTICS) {
        *out = each.value({sums, i});
        out += room;
    }
}

}  // namespace gearbox
