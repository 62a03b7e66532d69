#pragma once

// Products of a small matrix and vectors, in vector registers.
//
// out[i] = sum over m of rows[m][i] weights[m], for all i up to the capacity. Rows are added in
// blocks of eight; those beyond `count` are zero.

#include "capacities.hpp"

namespace gearbox {

constexpr int BLOCK = 8;  // rows added up at a time

namespace vector {

inline void combine_block(const double (*rows)[BODIES], const double* w, double* sum) {
    for (int i = 0; i < BODIES; ++i) {
        double low = rows[0][i] * w[0] + rows[1][i] * w[1] + rows[2][i] * w[2] + rows[3][i] * w[3];
        sum[i] =
            low + rows[4][i] * w[4] + rows[5][i] * w[5] + rows[6][i] * w[6] + rows[7][i] * w[7];
    }
}

}  // namespace vector

// Fill out (BODIES,) from rows (`count`, BODIES) and weights (`count`,).
inline void combine(const double (*rows)[BODIES], const double* weights, std::int64_t count,
                    double* out) {
    double low[BODIES], high[BODIES] = {};
    vector::combine_block(rows, weights, low);
    if (count > BLOCK) vector::combine_block(rows + BLOCK, weights + BLOCK, high);
    for (int i = 0; i < BODIES; ++i) out[i] = low[i] + high[i];
}

}  // namespace gearbox
