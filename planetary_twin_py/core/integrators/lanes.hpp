#pragma once

// Loops over bodies, modes or meshes have a count that the compiler knows.

#include <type_traits>
#include <utility>

#include "rooms.hpp"
#include "train/train.hpp"

namespace gearbox {

inline constexpr int HALF_ROOM = BODIES / 2;

// Call `function` with the number of lanes as a constant; lanes beyond those in use are zero.
template <class Function>
inline decltype(auto) with_lanes(const Train& train, Function&& function) {
    if (train.lanes <= HALF_ROOM) return function(std::integral_constant<int, HALF_ROOM>{});
    return function(std::integral_constant<int, BODIES>{});
}

template <int L>
inline void copy(const double* source, double* target) {
    for (int i = 0; i < L; ++i) target[i] = source[i];
}

// out[i] = sum over m of rows[m][i] weights[m]; rows and weights beyond those in use are zero.
template <int L>
inline void sum_rows(const double (*rows)[BODIES], const double* weights, double* out) {
    double sum[L] = {};
    for (int m = 0; m < L; ++m)
        for (int i = 0; i < L; ++i) sum[i] += rows[m][i] * weights[m];
    for (int i = 0; i < L; ++i) out[i] = sum[i];
}

// The same for two vectors at once, which takes hardly longer than for one.
template <int L>
inline void sum_rows_twice(const double (*rows)[BODIES], const double* first, const double* second,
                           double* out_first, double* out_second) {
    double one[L] = {}, two[L] = {};
    for (int m = 0; m < L; ++m)
        for (int i = 0; i < L; ++i) {
            one[i] += rows[m][i] * first[m];
            two[i] += rows[m][i] * second[m];
        }
    for (int i = 0; i < L; ++i) {
        out_first[i] = one[i];
        out_second[i] = two[i];
    }
}

}  // namespace gearbox
