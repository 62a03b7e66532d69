#pragma once

// Means and largest magnitudes of the columns of a table of samples, added row after row as NumPy
// does.

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gearbox {

// Means of `columns` columns; there must be a row.
inline void column_means(const double* values, std::int64_t rows, std::int64_t columns,
                         double* out) {
    std::copy_n(values, columns, out);
    for (std::int64_t row = 1; row < rows; ++row)
        for (std::int64_t c = 0; c < columns; ++c) out[c] += values[row * columns + c];
    for (std::int64_t c = 0; c < columns; ++c) out[c] /= static_cast<double>(rows);
}

// Largest magnitudes of `count` vectors with two components each.
inline void largest_magnitudes(const double* vectors, std::int64_t rows, std::int64_t count,
                               double* out) {
    std::fill_n(out, count, 0.0);
    for (std::int64_t row = 0; row < rows; ++row)
        for (std::int64_t n = 0; n < count; ++n) {
            const double* vector = vectors + 2 * (row * count + n);
            const double square = vector[0] * vector[0] + vector[1] * vector[1];
            if (!(square <= out[n])) out[n] = square;  // also if it is not a number
        }
    for (std::int64_t n = 0; n < count; ++n) out[n] = std::sqrt(out[n]);
}

}  // namespace gearbox
