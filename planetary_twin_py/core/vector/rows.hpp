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

template <int L>
LAW Mask<L> operator!(const Mask<L>& a) {
    Mask<L> out;
    for (int k = 0; k < L / WIDTH; ++k) out.part[k] = ~a.part[k];
    return out;
}

// Whether a condition holds for no number.
template <int L>
LAW bool none(const Mask<L>& a) {
    MaskRegister any = a.part[0];
    for (int k = 1; k < L / WIDTH; ++k) any |= a.part[k];
    std::int64_t found = 0;
    for (int i = 0; i < WIDTH; ++i) found |= any[i];
    return found == 0;
}

struct Places {
    alignas(64) double number[BODIES];

    constexpr Places() : number{} {
        for (int i = 0; i < BODIES; ++i) number[i] = i;
    }
};
inline constexpr Places PLACES;

// The first numbers of a row.
template <int L>
LAW Mask<L> first_of_row(std::int64_t count) {
    return Row<L>(PLACES.number) < static_cast<double>(count);
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

// Join all numbers of a row by halves, in an order that does not depend on the registers.
template <int L, class Join>
LAW double fold(const Row<L>& a, Join&& join) {
    double part[L];
#pragma GCC unroll 40
    for (int i = 0; i < L; ++i) part[i] = a[i];
    if constexpr ((L & (L - 1)) == 0) {
#pragma GCC unroll 4
        for (int half = L / 2; half > 0; half /= 2)
#pragma GCC unroll 8
            for (int i = 0; i < half; ++i) part[i] = join(part[i], part[i + half]);
    } else {  // the upper half may be one number shorter
        for (int size = L; size > 1; size -= size / 2)
            for (int i = 0; i < size / 2; ++i) part[i] = join(part[i], part[i + size - size / 2]);
    }
    return part[0];
}

template <int L>
LAW double total(const Row<L>& a) {
    return fold(a, [](double x, double y) { return x + y; });
}

// The largest number; what is no number may be lost.
template <int L>
LAW double largest(const Row<L>& a) {
    return fold(a, [](double x, double y) { return y > x ? y : x; });
}

// Lanes in which small trains have room: 3 planets, or planets of the same motion where axes move;
// then 4 planets whose axes move.
inline constexpr int FEW_LANES = 8, MORE_LANES = 24;

// Call `function` with the number of lanes as a constant; lanes beyond those in use are zero.
template <class Function>
inline decltype(auto) with_lanes(const Train& train, Function&& function) {
    if (train.lanes <= FEW_LANES) return function(std::integral_constant<int, FEW_LANES>{});
    if constexpr (MOVING)
        if (train.lanes <= MORE_LANES) return function(std::integral_constant<int, MORE_LANES>{});
    return function(std::integral_constant<int, BODIES>{});
}

template <int L>
LAW void copy(const double* source, double* target) {
    Row<L>(source).store(target);
}

// Sum over m of rows[m] weights[m]; rows and weights beyond those in use are zero.
//
// Weights that have just been computed are best given as a Row: read back from memory, each would
// wait until all of the row is written.
template <int L, class Weights>
LAW Row<L> sum_rows(const double (*rows)[BODIES], const Weights& weights) {
    Row<L> sum = Row<L>(rows[0]) * weights[0];
#pragma GCC unroll 16
    for (int m = 1; m < L; ++m) sum += Row<L>(rows[m]) * weights[m];
    return sum;
}

// Two rows that belong together, as values and their rates.
template <int L>
struct RowPair {
    Row<L> first, second;
};

// The same sums for two rows of weights.
template <int L>
LAW RowPair<L> sum_rows(const double (*rows)[BODIES], const RowPair<L>& weights) {
    return {sum_rows<L>(rows, weights.first), sum_rows<L>(rows, weights.second)};
}

}  // namespace gearbox
