#pragma once

// Several doubles in one vector register. Formulas that are templates over `Real` take a double or
// `Lanes`, with bitwise identical results.
//
// Products are fused with sums only where a formula requests it, never by the compiler: levels v3
// and v4 give bitwise identical results with any compiler.

#include <bit>
#include <cmath>
#include <cstdint>

#include "vector/attributes.hpp"
#include "vector/instructions.hpp"

namespace gearbox {

namespace vector {

template <class Real>
struct bits_of;
template <>
struct bits_of<double> {
    using type = std::uint64_t;
};
template <>
struct bits_of<Lanes> {
    using type = LanesBits;
};

template <class Real>
ALWAYS_INLINE typename bits_of<Real>::type to_bits(Real x) {
    return std::bit_cast<typename bits_of<Real>::type>(x);
}

template <class Real>
ALWAYS_INLINE Real from_bits(typename bits_of<Real>::type bits) {
    return std::bit_cast<Real>(bits);
}

constexpr std::uint64_t SIGN = std::uint64_t{1} << 63;

}  // namespace vector

// The larger (smaller) of both; `x` if that is NaN, so that a bound does not hide an error.
ALWAYS_INLINE constexpr double at_least(double x, double bound) {
    return bound > x ? bound : x;
}
ALWAYS_INLINE constexpr double at_most(double x, double bound) {
    return bound < x ? bound : x;
}

ALWAYS_INLINE Lanes at_least(Lanes x, Lanes bound) {
    return vector::larger(x, bound);
}
ALWAYS_INLINE Lanes at_most(Lanes x, Lanes bound) {
    return vector::smaller(x, bound);
}
ALWAYS_INLINE Lanes at_least(Lanes x, double bound) {
    return at_least(x, Lanes{} + bound);
}
ALWAYS_INLINE Lanes at_most(Lanes x, double bound) {
    return at_most(x, Lanes{} + bound);
}

template <class Real>
ALWAYS_INLINE Real magnitude(Real x) {
    return vector::from_bits<Real>(vector::to_bits(x) & ~vector::SIGN);
}

// The magnitude of x with the sign of y.
template <class Real>
ALWAYS_INLINE Real with_sign(Real x, Real y) {
    return vector::from_bits<Real>((vector::to_bits(x) & ~vector::SIGN) |
                                   (vector::to_bits(y) & vector::SIGN));
}

// `then` where x is less than the bound.
ALWAYS_INLINE double where_less(double x, double bound, double then, double otherwise) {
    return x < bound ? then : otherwise;
}
ALWAYS_INLINE Lanes where_less(Lanes x, double bound, Lanes then, Lanes otherwise) {
    return x < bound ? then : otherwise;
}
ALWAYS_INLINE Lanes where_less(Lanes x, double bound, double then, double otherwise) {
    return where_less(x, bound, then - Lanes{}, otherwise - Lanes{});
}

// a b + c, rounded once where the level has fused products, else twice.
ALWAYS_INLINE double fused(double a, double b, double c) {
    return vector::multiply_add(a, b, c);
}
ALWAYS_INLINE Lanes fused(Lanes a, Lanes b, Lanes c) {
    return vector::multiply_add(a, b, c);
}
ALWAYS_INLINE Lanes fused(Lanes a, double b, Lanes c) {
    return fused(a, b - Lanes{}, c);
}
ALWAYS_INLINE Lanes fused(Lanes a, Lanes b, double c) {
    return fused(a, b, c - Lanes{});
}
ALWAYS_INLINE Lanes fused(Lanes a, double b, double c) {
    return fused(a, b - Lanes{}, c - Lanes{});
}

// The largest whole number that is not above x, for magnitudes below 2^51. Adding 1.5 * 2^52 rounds
// to a whole number.
template <class Real>
ALWAYS_INLINE Real whole_below(Real x) {
    constexpr double ROUNDING = 0x1.8p52;
    Real near = (x + ROUNDING) - ROUNDING;
    return near > x ? near - 1.0 : near;
}

ALWAYS_INLINE double square_root(double x) {
    return std::sqrt(x);
}

ALWAYS_INLINE Lanes square_root(Lanes x) {
    return vector::root(x);
}

}  // namespace gearbox
