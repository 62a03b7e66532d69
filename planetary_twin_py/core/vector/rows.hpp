#pragma once

// Rows of numbers in vector registers, one for each body, mode or mesh.
//
// Every operation acts on each number separately, so results do not depend on the width of the
// registers.

#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "capacities.hpp"
#include "model/train.hpp"
#include "vector/attributes.hpp"
#include "vector/lanes.hpp"

namespace gearbox {

// A loop over the registers of a row, unrolled: gcc keeps a row in registers only if it is.
#define EACH_PART(k, L) _Pragma("GCC unroll 16") for (int k = 0; k < (L) / WIDTH; ++k)

using MaskRegister [[gnu::vector_size(8 * WIDTH)]] = std::int64_t;

// For each number of a row, whether a condition holds.
template <int L>
struct Mask {
    MaskRegister part[L / WIDTH];
};

// A register at the address of its first number, in one access: gcc copies bytes in halves.
struct [[gnu::packed, gnu::may_alias]] InMemory {
    Lanes lanes;
};

template <int L>
struct Row {
    static constexpr int PARTS = L / WIDTH;
    Lanes part[PARTS];

    Row() = default;

    // One register is copied as it is, several in turn: gcc copies a structure of these in halves,
    // by way of the stack.
    Row(const Row& other)
        requires(PARTS == 1)
    = default;
    Row& operator=(const Row& other)
        requires(PARTS == 1)
    = default;
    ALWAYS_INLINE Row(const Row& other) { EACH_PART(k, L) part[k] = other.part[k]; }
    ALWAYS_INLINE Row& operator=(const Row& other) {
        EACH_PART(k, L) part[k] = other.part[k];
        return *this;
    }

    ALWAYS_INLINE Row(double value) { EACH_PART(k, L) part[k] = value - Lanes{}; }

    ALWAYS_INLINE explicit Row(const double* values) {
        EACH_PART(k, L) part[k] = reinterpret_cast<const InMemory*>(values + k * WIDTH)->lanes;
    }

    ALWAYS_INLINE void store(double* values) const {
        EACH_PART(k, L) reinterpret_cast<InMemory*>(values + k * WIDTH)->lanes = part[k];
    }

    ALWAYS_INLINE double operator[](int i) const { return part[i / WIDTH][i % WIDTH]; }

    ALWAYS_INLINE Row& operator+=(const Row& other) { return *this = *this + other; }
    ALWAYS_INLINE Row& operator-=(const Row& other) { return *this = *this - other; }
    ALWAYS_INLINE Row& operator*=(const Row& other) { return *this = *this * other; }
};

#define ROW_ARITHMETIC(sign)                                               \
    template <int L>                                                       \
    ALWAYS_INLINE Row<L> operator sign(const Row<L>& a, const Row<L>& b) { \
        Row<L> out;                                                        \
        EACH_PART(k, L) out.part[k] = a.part[k] sign b.part[k];            \
        return out;                                                        \
    }                                                                      \
    template <int L>                                                       \
    ALWAYS_INLINE Row<L> operator sign(const Row<L>& a, double b) {        \
        return a sign Row<L>(b);                                           \
    }                                                                      \
    template <int L>                                                       \
    ALWAYS_INLINE Row<L> operator sign(double a, const Row<L>& b) {        \
        return Row<L>(a) sign b;                                           \
    }
ROW_ARITHMETIC(+)
ROW_ARITHMETIC(-)
ROW_ARITHMETIC(*)
ROW_ARITHMETIC(/)
#undef ROW_ARITHMETIC

// a b + c of each number, see `lanes.hpp`.
template <int L>
ALWAYS_INLINE Row<L> fused(const Row<L>& a, const Row<L>& b, const Row<L>& c) {
    Row<L> out;
    EACH_PART(k, L) out.part[k] = fused(a.part[k], b.part[k], c.part[k]);
    return out;
}
template <int L>
ALWAYS_INLINE Row<L> fused(const Row<L>& a, double b, const Row<L>& c) {
    return fused(a, Row<L>(b), c);
}
template <int L>
ALWAYS_INLINE Row<L> fused(double a, const Row<L>& b, const Row<L>& c) {
    return fused(Row<L>(a), b, c);
}

#define ROW_COMPARISON(sign)                                                \
    template <int L>                                                        \
    ALWAYS_INLINE Mask<L> operator sign(const Row<L>& a, const Row<L>& b) { \
        Mask<L> out;                                                        \
        EACH_PART(k, L) out.part[k] = a.part[k] sign b.part[k];             \
        return out;                                                         \
    }                                                                       \
    template <int L>                                                        \
    ALWAYS_INLINE Mask<L> operator sign(const Row<L>& a, double b) {        \
        return a sign Row<L>(b);                                            \
    }
ROW_COMPARISON(<)
ROW_COMPARISON(>)
ROW_COMPARISON(==)
#undef ROW_COMPARISON

template <int L>
ALWAYS_INLINE Mask<L> operator&(const Mask<L>& a, const Mask<L>& b) {
    Mask<L> out;
    EACH_PART(k, L) out.part[k] = a.part[k] & b.part[k];
    return out;
}

template <int L>
ALWAYS_INLINE Mask<L> operator|(const Mask<L>& a, const Mask<L>& b) {
    Mask<L> out;
    EACH_PART(k, L) out.part[k] = a.part[k] | b.part[k];
    return out;
}

template <int L>
ALWAYS_INLINE Mask<L> operator!(const Mask<L>& a) {
    Mask<L> out;
    EACH_PART(k, L) out.part[k] = ~a.part[k];
    return out;
}

// Whether a condition holds for no number.
template <int L>
ALWAYS_INLINE bool none(const Mask<L>& a) {
    MaskRegister any = a.part[0];
    for (int k = 1; k < L / WIDTH; ++k) any |= a.part[k];
    return is_zero(std::bit_cast<LanesBits>(any));
}

// The numbers for which a condition holds, as bits.
template <int L>
ALWAYS_INLINE std::uint64_t places(const Mask<L>& a) {
    std::uint64_t bits = 0;
    EACH_PART(k, L)
    bits |= std::uint64_t{sign_bits(std::bit_cast<LanesBits>(a.part[k]))} << (k * WIDTH);
    return bits;
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
ALWAYS_INLINE Mask<L> first_of_row(std::int64_t count) {
    return Row<L>(PLACES.number) < static_cast<double>(count);
}

// `a` where the mask holds, else `b`.
template <int L>
ALWAYS_INLINE Row<L> select(const Mask<L>& mask, const Row<L>& a, const Row<L>& b) {
    Row<L> out;
    EACH_PART(k, L) out.part[k] = mask.part[k] ? a.part[k] : b.part[k];
    return out;
}

template <int L>
ALWAYS_INLINE Row<L> select(const Mask<L>& mask, const Row<L>& a, double b) {
    return select(mask, a, Row<L>(b));
}

template <int L>
ALWAYS_INLINE Row<L> select(const Mask<L>& mask, double a, const Row<L>& b) {
    return select(mask, Row<L>(a), b);
}

// The larger (smaller) of both; the first if it is not a number.
template <int L>
ALWAYS_INLINE Row<L> larger(const Row<L>& a, const Row<L>& b) {
    Row<L> out;
    EACH_PART(k, L) out.part[k] = at_least(a.part[k], b.part[k]);
    return out;
}

template <int L>
ALWAYS_INLINE Row<L> smaller(const Row<L>& a, const Row<L>& b) {
    Row<L> out;
    EACH_PART(k, L) out.part[k] = at_most(a.part[k], b.part[k]);
    return out;
}

#define ROW_FUNCTION(name, of_register)                       \
    template <int L>                                          \
    ALWAYS_INLINE Row<L> name(const Row<L>& a) {              \
        Row<L> out;                                           \
        EACH_PART(k, L) out.part[k] = of_register(a.part[k]); \
        return out;                                           \
    }
ROW_FUNCTION(operator-, -)
ROW_FUNCTION(absolute, magnitude)
ROW_FUNCTION(whole_below, whole_below)
ROW_FUNCTION(square_root, square_root)
#undef ROW_FUNCTION

// Join the numbers of a register by halves.
template <class Part, class Join>
ALWAYS_INLINE double fold_register(const Part& a, Join&& join) {
    if constexpr (sizeof(Part) == 64)
        return fold_register(join(__builtin_shufflevector(a, a, 0, 1, 2, 3),
                                  __builtin_shufflevector(a, a, 4, 5, 6, 7)),
                             join);
    else if constexpr (sizeof(Part) == 32)
        return fold_register(
            join(__builtin_shufflevector(a, a, 0, 1), __builtin_shufflevector(a, a, 2, 3)), join);
    else
        return join(a[0], a[1]);
}

// Join all numbers of a row: blocks of eight one after another, then the numbers of the result by
// halves, an order that does not depend on the registers.
template <int L, class Join>
ALWAYS_INLINE double fold(const Row<L>& a, Join&& join) {
    constexpr int BLOCK = 8 / WIDTH;
    Row<8> sum;
    for (int k = 0; k < BLOCK; ++k) sum.part[k] = a.part[k];
    for (int k = BLOCK; k < Row<L>::PARTS; ++k)
        sum.part[k % BLOCK] = join(sum.part[k % BLOCK], a.part[k]);
    for (int half = BLOCK / 2; half > 0; half /= 2)
        for (int k = 0; k < half; ++k) sum.part[k] = join(sum.part[k], sum.part[k + half]);
    return fold_register(sum.part[0], join);
}

template <int L>
ALWAYS_INLINE double total(const Row<L>& a) {
    return fold(a, [](auto x, auto y) { return x + y; });
}

// The largest number; NaN may be ignored.
template <int L>
ALWAYS_INLINE double largest(const Row<L>& a) {
    return fold(a, [](auto x, auto y) { return y > x ? y : x; });
}

// A number of lanes in whole registers of this level.
constexpr int in_registers(int lanes) {
    return (lanes + WIDTH - 1) / WIDTH * WIDTH;
}

// Lanes of small trains: 4 planets, or planets of the same motion where axes move; 6 planets whose
// axes are fixed; then 4, 6 and 7 planets whose axes move in the plane, and 4 whose axes tilt.
inline constexpr int FEW_LANES = 8, FIXED_LANES = in_registers(12), MORE_LANES = 24,
                     PLANAR_LANES = in_registers(28), MANY_LANES = in_registers(36),
                     TILTING_LANES = in_registers(44);

// Lanes of the meshes of a train with L lanes of bodies: where axes move, it has fewer meshes.
template <int L>
inline constexpr int MESH_LANES = L == MORE_LANES || L == TILTING_LANES ? 16
                                  : L == PLANAR_LANES                   ? 24
                                  : L < MESHES                          ? L
                                                                        : MESHES;

// Call `function` with the first of these numbers of lanes that is enough for the train, or the
// last.
template <int FIRST, int... OTHERS, class Function>
inline decltype(auto) with_first_of(const Train& train, Function&& function) {
    if constexpr (sizeof...(OTHERS) > 0)
        if (train.lanes > FIRST || train.meshes > MESH_LANES<FIRST>)
            return with_first_of<OTHERS...>(train, function);
    return function(std::integral_constant<int, FIRST>{});
}

// Call `function` with the number of lanes of bodies and modes as a constant; lanes beyond those in
// use are zero.
template <class Function>
inline decltype(auto) with_lanes(const Train& train, Function&& function) {
    if constexpr (MOVING)
        return with_first_of<FEW_LANES, MORE_LANES, PLANAR_LANES, TILTING_LANES, MANY_LANES,
                             BODIES>(train, function);
    else
        return with_first_of<FEW_LANES, FIXED_LANES, BODIES>(train, function);
}

// Call `function` with the number of lanes of the meshes.
template <class Function>
inline decltype(auto) with_mesh_lanes(const Train& train, Function&& function) {
    return with_lanes(train, [&]<int L>(std::integral_constant<int, L>) -> decltype(auto) {
        return function(std::integral_constant<int, MESH_LANES<L>>{});
    });
}

// Number of the lanes of the meshes.
inline std::int64_t mesh_lanes(const Train& train) {
    return with_mesh_lanes(train, [](auto lanes) { return static_cast<std::int64_t>(lanes); });
}

template <int L>
ALWAYS_INLINE void copy(const double* source, double* target) {
    Row<L>(source).store(target);
}

// Rows of a matrix, without gaps between them.
struct MatrixRows {
    const double* first;
    std::int64_t lanes;  // of each
    std::int64_t count;  // of them, an even number; those beyond are zero

    const double* operator[](std::int64_t m) const { return first + m * lanes; }
};

// Number m of a row in all lanes of a register.
template <int M, int L>
ALWAYS_INLINE Lanes spread(const Row<L>& row) {
    return vector::spread<M % WIDTH>(row.part[M / WIDTH]);
}

// Add the row of L numbers at `row`, times a register with the same number in all lanes.
template <int L>
ALWAYS_INLINE void add_row(const double* row, const Lanes& weight, Row<L>& sum) {
    const Row<L> values(row);
    EACH_PART(k, L)
    sum.part[k] = fused(values.part[k], weight, sum.part[k]);
}

// Call `function` with the constants FIRST to LAST - 1.
template <int FIRST, int LAST, class Function>
ALWAYS_INLINE void for_each_of(Function&& function) {
    [&]<int... M>(std::integer_sequence<int, M...>) __attribute__((always_inline)) {
        (function(std::integral_constant<int, FIRST + M>{}), ...);
    }(std::make_integer_sequence<int, LAST - FIRST>{});
}

// Call `function` with the constants 0 to COUNT - 1, but not with those beyond the rows in use.
template <int COUNT, class Function>
ALWAYS_INLINE void for_each_row(const MatrixRows& rows, Function&& function) {
    constexpr int ALWAYS = COUNT < FEW_LANES ? COUNT : FEW_LANES;
    for_each_of<0, ALWAYS>(function);
    for_each_of<ALWAYS / 2, COUNT / 2>([&](auto k) __attribute__((always_inline)) {
        if (rows.count > 2 * k) for_each_of<2 * k, 2 * k + 2>(function);
    });
}

// Registers of a processor.
inline constexpr int REGISTERS = WIDTH == 8 ? 32 : 16;
// Largest number of weights for which the code of a sum is a straight line, row after row. Of
// narrow registers more would make it so long that fetching it takes more time than a loop.
inline constexpr int SPREAD_WEIGHTS = WIDTH == 8 ? MORE_LANES : FIXED_LANES;

// Sum over m of rows[m] weights[m]; weights beyond the rows in use are not read. The rows have L
// lanes.
//
// For weights that were written one by one: a row of them could only be read some time after the
// last is written.
template <int L>
ALWAYS_INLINE Row<L> sum_rows(const MatrixRows& rows, const double* weights) {
    Row<L> sum(0.0);
    for (std::int64_t m = 0; m < rows.count; m += 2)
        for (std::int64_t k = m; k < m + 2; ++k)
            sum = fused(Row<L>(rows.first + k * L), weights[k], sum);
    return sum;
}

// The same with a row of weights; those beyond the rows in use are zero.
//
// Weights that have just been computed are best passed as a Row: reading them from memory would
// stall until the whole row is written.
template <int L, int COUNT>
ALWAYS_INLINE Row<L> sum_rows(const MatrixRows& rows, const Row<COUNT>& weights) {
    if constexpr (COUNT <= SPREAD_WEIGHTS) {
        Row<L> sum(0.0);
        for_each_row<COUNT>(rows, [&](auto m) __attribute__((always_inline)) {
            add_row<L>(rows.first + m * L, spread<m>(weights), sum);
        });
        return sum;
    } else {
        alignas(64) double weight[COUNT];
        weights.store(weight);
        return sum_rows<L>(rows, weight);
    }
}

// Two related rows, e.g. values and their rates.
template <int L>
struct RowPair {
    Row<L> first, second;
};

// Of two sums over rows of L lanes, the registers from FIRST to LAST - 1: with all at once, most
// would be read from the stack and written back for each row.
template <int L, int FIRST, int LAST>
ALWAYS_INLINE void sum_block(const MatrixRows& rows, const double* first, const double* second,
                             RowPair<L>& sums) {
    constexpr int COUNT = (LAST - FIRST) * WIDTH;
    RowPair<COUNT> sum{0.0, 0.0};
    const double* row = rows.first + FIRST * WIDTH;
    for (std::int64_t m = 0; m < rows.count; ++m, row += L) {
        const Row<COUNT> values(row);
        sum.first = fused(values, first[m], sum.first);
        sum.second = fused(values, second[m], sum.second);
    }
    EACH_PART(k, COUNT) sums.first.part[FIRST + k] = sum.first.part[k];
    EACH_PART(k, COUNT) sums.second.part[FIRST + k] = sum.second.part[k];
}

// The same sums for two rows of weights.
template <int L, int COUNT>
ALWAYS_INLINE RowPair<L> sum_rows(const MatrixRows& rows, const RowPair<COUNT>& weights) {
    if constexpr (COUNT <= SPREAD_WEIGHTS) {
        RowPair<L> sum{0.0, 0.0};
        for_each_row<COUNT>(rows, [&](auto m) __attribute__((always_inline)) {
            add_row<L>(rows.first + m * L, spread<m>(weights.first), sum.first);
            add_row<L>(rows.first + m * L, spread<m>(weights.second), sum.second);
        });
        return sum;
    } else {
        alignas(64) double first[COUNT], second[COUNT];
        weights.first.store(first);
        weights.second.store(second);
        constexpr int PARTS = L / WIDTH, MOST = REGISTERS / 2 - 2;
        constexpr int BLOCKS = (PARTS + MOST - 1) / MOST;
        RowPair<L> sums;
        for_each_of<0, BLOCKS>([&](auto b) __attribute__((always_inline)) {
            sum_block<L, b * PARTS / BLOCKS, (b + 1) * PARTS / BLOCKS>(rows, first, second, sums);
        });
        return sums;
    }
}

}  // namespace gearbox
