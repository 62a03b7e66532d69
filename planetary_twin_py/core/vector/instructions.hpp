#pragma once

// Registers and their instructions: what differs between processors, and what the vector extensions
// of GCC do not express.
//
// Of each level its widest registers. All have the same results, except that `fused` rounds twice
// where FUSES is false.

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "vector/attributes.hpp"
#include "vector/intrinsics.hpp"

namespace gearbox {

#if defined(__AVX512F__)
constexpr int WIDTH = 8;
#elif defined(__AVX__)
constexpr int WIDTH = 4;
#else
constexpr int WIDTH = 2;
#endif

// Whether this level has fused products.
#if defined(__FMA__) || defined(__aarch64__)
constexpr bool FUSES = true;
#else
constexpr bool FUSES = false;
#endif

using Lanes [[gnu::vector_size(8 * WIDTH)]] = double;
using LanesBits [[gnu::vector_size(8 * WIDTH)]] = std::uint64_t;

inline constexpr int FLOATS = 2 * WIDTH;
using FloatRegister [[gnu::vector_size(4 * FLOATS)]] = float;
using HalfRegister [[gnu::vector_size(4 * WIDTH)]] = float;  // as many floats as doubles

namespace vector {

// a < b ? b : a and b < a ? b : a of each number, so `a` if one is not a number. gcc 12 does not
// always find their instruction.
#if defined(__AVX512F__)  // with masks gcc 12 does not warn about its own headers
#define OF_DOUBLES(name, ...) _mm512_maskz_##name##_pd(0xFF, __VA_ARGS__)
#define OF_FLOATS(name, ...) _mm512_maskz_##name##_ps(0xFFFF, __VA_ARGS__)
#elif defined(__AVX__)
#define OF_DOUBLES(name, ...) _mm256_##name##_pd(__VA_ARGS__)
#define OF_FLOATS(name, ...) _mm256_##name##_ps(__VA_ARGS__)
#elif defined(__x86_64__)
#define OF_DOUBLES(name, ...) _mm_##name##_pd(__VA_ARGS__)
#define OF_FLOATS(name, ...) _mm_##name##_ps(__VA_ARGS__)
#endif
#if defined(__x86_64__)
ALWAYS_INLINE Lanes larger(Lanes a, Lanes b) {
    return OF_DOUBLES(max, b, a);
}
ALWAYS_INLINE Lanes smaller(Lanes a, Lanes b) {
    return OF_DOUBLES(min, b, a);
}
ALWAYS_INLINE FloatRegister larger(FloatRegister a, FloatRegister b) {
    return OF_FLOATS(max, b, a);
}
ALWAYS_INLINE FloatRegister smaller(FloatRegister a, FloatRegister b) {
    return OF_FLOATS(min, b, a);
}
#else  // NEON, whose maximum is not a number if one of both is not
template <class Register>
ALWAYS_INLINE Register larger(Register a, Register b) {
    return a < b ? b : a;
}
template <class Register>
ALWAYS_INLINE Register smaller(Register a, Register b) {
    return b < a ? b : a;
}
#endif
#undef OF_DOUBLES
#undef OF_FLOATS

// Square roots, which gcc joins to one instruction.
template <class Register>
ALWAYS_INLINE Register root(Register x) {
    constexpr int COUNT = sizeof x / sizeof x[0];
#pragma GCC unroll 16
    for (int k = 0; k < COUNT; ++k) x[k] = std::sqrt(x[k]);
    return x;
}

// a b + c.
ALWAYS_INLINE Lanes multiply_add(Lanes a, Lanes b, Lanes c) {
#if defined(__AVX512F__)
    return _mm512_fmadd_pd(a, b, c);
#elif defined(__FMA__)
    return _mm256_fmadd_pd(a, b, c);
#elif defined(__aarch64__)
    return vfmaq_f64(c, a, b);
#else
    return a * b + c;
#endif
}

ALWAYS_INLINE FloatRegister multiply_add(FloatRegister a, FloatRegister b, FloatRegister c) {
#if defined(__AVX512F__)
    return _mm512_fmadd_ps(a, b, c);
#elif defined(__FMA__)
    return _mm256_fmadd_ps(a, b, c);
#elif defined(__aarch64__)
    return vfmaq_f32(c, a, b);
#else
    return a * b + c;
#endif
}

ALWAYS_INLINE double multiply_add(double a, double b, double c) {
    if constexpr (FUSES)
        return __builtin_fma(a, b, c);
    else
        return a * b + c;
}

// Number K of a register in all its lanes.
//
// Of eight lanes, by two permutations with constants, the first of which serves four numbers: for a
// general one gcc builds the places in a register of integers, three instructions each time.
template <int K>
ALWAYS_INLINE Lanes spread(Lanes x) {
#if defined(__AVX512F__)
    constexpr int BOTH = K < 4 ? 0x44 : 0xEE, EACH = 0x55 * (K % 4);
    const Lanes halves = _mm512_maskz_shuffle_f64x2(0xFF, x, x, BOTH);
    return _mm512_maskz_permutex_pd(0xFF, halves, EACH);
#elif defined(__AVX__)
    return __builtin_shufflevector(x, x, K, K, K, K);
#else
    return __builtin_shufflevector(x, x, K, K);
#endif
}

// A register of doubles from floats, in one instruction: gcc converts halves of wide registers.
ALWAYS_INLINE Lanes doubles_at(const float* first) {
#if defined(__AVX512F__)
    return _mm512_maskz_cvtps_pd(0xFF, _mm256_loadu_ps(first));
#elif defined(__AVX__)
    return _mm256_cvtps_pd(_mm_loadu_ps(first));
#else
    HalfRegister floats;
    std::memcpy(&floats, first, sizeof floats);
    return __builtin_convertvector(floats, Lanes);
#endif
}

}  // namespace vector

// Whether all bits of all lanes are zero.
ALWAYS_INLINE bool is_zero(LanesBits x) {
#if defined(__AVX512F__)
    auto bits = std::bit_cast<__m512i>(x);
    return _mm512_test_epi64_mask(bits, bits) == 0;
#elif defined(__AVX__)
    auto bits = std::bit_cast<__m256i>(x);
    return _mm256_testz_si256(bits, bits) != 0;
#else
    return (x[0] | x[1]) == 0;
#endif
}

// The first bit of each lane.
ALWAYS_INLINE unsigned sign_bits(LanesBits x) {
#if defined(__AVX512F__)
    return _mm512_movepi64_mask(std::bit_cast<__m512i>(x));
#elif defined(__AVX__)
    return static_cast<unsigned>(_mm256_movemask_pd(std::bit_cast<__m256d>(x)));
#elif defined(__x86_64__)
    return static_cast<unsigned>(_mm_movemask_pd(std::bit_cast<__m128d>(x)));
#else
    return static_cast<unsigned>((x[0] >> 63) | (x[1] >> 63) << 1);
#endif
}

}  // namespace gearbox
