#pragma once

// Mean, rms and peak values of the meshes over an interval, from its integrals for each mesh.

#include <cmath>
#include <cstdint>

#include "mesh/mesh_sums.hpp"

namespace gearbox {

// Rows of the results of every mesh.
constexpr int MEAN_DTE = 0, RMS_DTE = 1, LARGEST_DTE = 2, MEAN_FORCE = 3, LARGEST_FORCE = 4,
              IN_CONTACT = 5, WITHOUT_VISCOUS = 6, MEAN_FILM = 7, MEAN_LAMBDA = 8,
              MEAN_BOUNDARY = 9, MEAN_VISCOUS = 10, MEAN_LOSS = 11;
constexpr int STATISTICS = 12;

constexpr double ROUNDING_OF_SUM = 1e-12;  // of the sum of the steps of an interval

// A fraction of time, without rounding errors near 0 and 1.
inline double fraction_of_time(double mean) {
    if (std::fabs(mean - 1.0) < ROUNDING_OF_SUM || mean > 1.0) return 1.0;
    return std::fabs(mean) < ROUNDING_OF_SUM || mean < 0.0 ? 0.0 : mean;
}

// Statistics of mesh i to out[row * room], see STATISTICS.
//
// The rms value is that of the deviation from the mean. Film thickness and lambda ratio are means
// over the time in which they are known, NaN if there is no such time.
inline void mesh_statistics(const MeshSums& sums, std::int64_t i, double* out, std::int64_t room) {
    auto mean = [&](int row) { return sums.integral[row][i] / sums.time; };
    auto put = [&](int row, double value) { out[row * room] = value; };
    double dte = mean(DTE), square = mean(SQUARE) - dte * dte, filmed = mean(FILMED);
    put(MEAN_DTE, dte);
    put(RMS_DTE, std::sqrt(square < 0.0 ? 0.0 : square));
    put(LARGEST_DTE, sums.dte_peak[i]);
    put(MEAN_FORCE, mean(MESH_FORCE));
    put(LARGEST_FORCE, sums.force_peak[i]);
    put(IN_CONTACT, fraction_of_time(mean(CONTACT)));
    put(WITHOUT_VISCOUS, fraction_of_time(mean(CLIPPED)));
    put(MEAN_FILM, mean(FILM) / filmed);
    put(MEAN_LAMBDA, mean(LAMBDA) / filmed);
    put(MEAN_BOUNDARY, mean(BOUNDARY));
    put(MEAN_VISCOUS, mean(VISCOUS));
    put(MEAN_LOSS, mean(POWER_LOSS));
}

}  // namespace gearbox
