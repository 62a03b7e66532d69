#pragma once

// Rows of numbers in vector registers, one for each body, mode or mesh.
//
// Every operation acts on each number by itself, so what comes out does not depend on the width of
// the registers.

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "rooms.hpp"
#include "train/train.hpp"
#include "vector/lanes.hpp"
#include "vector/law.hpp"

namespace gearbox {

using MaskRegister [[gnu::vector_size(8 * WIDTH)]] = std::int64_t;

// Which numbers of a row a condition holds for.
template <int L>
struct Mask {
    MaskRegister part[L / WIDTH];
};

template <int L>
struct Row {
    static constexpr int PARTS = L / WIDTH;
    Lanes part[PARTS];

    Row() = default;

    LAW Row(double value) {
        for (int k = 0; k < PARTS; ++k) part[k] = value - Lanes{};
    }

    LAW explicit Row(const double* values) {
        for (int k = 0; k < PARTS; ++k) __builtin_memcpy(&part[k], values + k * WIDTH, 8 * WIDTH);
    }

    LAW void store(double* values) const {
        for (int k = 0; k < PARTS; ++k) __builtin_memcpy(values + k * WIDTH, &part[k], 8 * WIDTH);
    }

    LAW double operator[](int i) const { return part[i / WIDTH][i % WIDTH]; }

    LAW Row& operator+=(const Row& other) { return *this = *this + other; }
    LAW Row& operator-=(const Row& other) { return *this = *this - other; }
    LAW Row& operator*=(const Row& other) { return *this = *this * other; }
};

#define ROW_ARITHMETIC(sign)                                                            \
    template <int L>                                                                    \
    LAW Row<L> operator sign(const Row<L>& a, const Row<L>& b) {                        \
        Row<L> out;                                                                     \
        for (int k = 0; k < Row<L>::PARTS; ++k) out.part[k] = a.part[k] sign b.part[k]; \
        return out;                                                                     \
    }                                                                                   \
    template <int L>                                                                    \
    LAW Row<L> operator sign(const Row<L>& a, double b) {                               \
        Row<L> out;                                                                     \
        for (int k = 0; k < Row<L>::PARTS; ++k) out.part[k] = a.part[k] sign b;         \
        return out;                                                                     \
    }                                                                                   \
    template <int L>                                                                    \
    LAW Row<L> operator sign(double a, const Row<L>& b) {                               \
        Row<L> out;                                                                     \
        for (int k = 0; k < Row<L>::PARTS; ++k) out.part[k] = a sign b.part[k];         \
        return out;                                                                     \
    }
ROW_ARITHMETIC(+)
ROW_ARITHMETIC(-)
ROW_ARITHMETIC(*)
ROW_ARITHMETIC(/)
#undef ROW_ARITHMETIC

#define ROW_COMPARISON(sign)                                                            \
    template <int L>                                                                    \
    LAW Mask<L> operator sign(const Row<L>& a, const Row<L>& b) {                       \
        Mask<L> out;                                                                    \
        for (int k = 0; k < Row<L>::PARTS; ++k) out.part[k] = a.part[k] sign b.part[k]; \
        return out;                                                                     \
    }                                                                                   \
    template <int L>                                                                    \
    LAW Mask<L> operator sign(const Row<L>& a, double b) {                              \
        return a sign Row<L>(b);                                                        \
    }
ROW_COMPARISON(<)
ROW_COMPARISON(>)
ROW_COMPARISON(==)
#undef ROW_COMPARISON

template <int L>
LAW Mask<L> operator&(const Mask<L>& a, const Mask<L>& b) {
    Mask<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = a.part[k] & b.part[k];
    return out;
}

// `a` where the mask holds, else `b`.
template <int L>
LAW Row<L> select(const Mask<L>& mask, const Row<L>& a, const Row<L>& b) {
    Row<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = mask.part[k] ? a.part[k] : b.part[k];
    return out;
}

template <int L>
LAW Row<L> select(const Mask<L>& mask, const Row<L>& a, double b) {
    return select(mask, a, Row<L>(b));
}

template <int L>
LAW Row<L> select(const Mask<L>& mask, double a, const Row<L>& b) {
    return select(mask, Row<L>(a), b);
}

// The larger (smaller) of both; the first if it is not a number.
template <int L>
LAW Row<L> larger(const Row<L>& a, const Row<L>& b) {
    Row<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = at_least(a.part[k], b.part[k]);
    return out;
}

template <int L>
LAW Row<L> smaller(const Row<L>& a, const Row<L>& b) {
    Row<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = at_most(a.part[k], b.part[k]);
    return out;
}

template <int L>
LAW Row<L> absolute(const Row<L>& a) {
    Row<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = magnitude(a.part[k]);
    return out;
}

template <int L>
LAW Row<L> square_root(const Row<L>& a) {
    Row<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = square_root(a.part[k]);
    return out;
}

// Sum in the order of the row.
template <int L>
LAW double total(const Row<L>& a) {
    double sum = a[0];
    for (int i = 1; i < L; ++i) sum += a[i];
    return sum;
}

template <int L>
LAW double largest(const Row<L>& a) {
    double found = a[0];
    for (int i = 1; i < L; ++i) found = a[i] > found ? a[i] : found;
    return found;
}

// Numbers that are room for all bodies or meshes.
inline constexpr int HALF_ROOM = BODIES / 2;

// Call `function` with the number of lanes as a constant; lanes beyond those in use are zero.
template <class Function>
inline decltype(auto) with_lanes(const Train& train, Function&& function) {
    if (train.lanes <= HALF_ROOM) return function(std::integral_constant<int, HALF_ROOM>{});
    return function(std::integral_constant<int, BODIES>{});
}

template <int L>
LAW void copy(const double* source, double* target) {
    Row<L>(source).store(target);
}

// Sum over m of rows[m] weights[m]; rows and weights beyond those in use are zero.
template <int L>
LAW Row<L> sum_rows(const double (*rows)[BODIES], const double* weights) {
    Row<L> sum = Row<L>(rows[0]) * weights[0];
    for (int m = 1; m < L; ++m) sum += Row<L>(rows[m]) * weights[m];
    return sum;
}

template <int L>
LAW void sum_rows(const double (*rows)[BODIES], const double* weights, double* out) {
    sum_rows<L>(rows, weights).store(out);
}

// The same for two vectors at once, which takes hardly longer than for one.
template <int L>
LAW void sum_rows_twice(const double (*rows)[BODIES], const double* first, const double* second,
                        double* out_first, double* out_second) {
    Row<L> row(rows[0]), one = row * first[0], two = row * second[0];
    for (int m = 1; m < L; ++m) {
        row = Row<L>(rows[m]);
        one += row * first[m];
        two += row * second[m];
    }
    one.store(out_first);
    two.store(out_second);
}

}  // namespace gearbox
