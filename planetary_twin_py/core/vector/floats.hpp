#pragma once

// Floats in one vector register, twice as many as doubles: for formulas that are templates over
// `Real`, where six digits are enough. exp and log have errors of some units of the last digit.

#include <cstdint>

#include "vector/attributes.hpp"
#include "vector/lanes.hpp"
#include "vector/math.hpp"

namespace gearbox {

using FloatBits [[gnu::vector_size(4 * FLOATS)]] = std::uint32_t;

struct Floats {
    FloatRegister value;

    Floats() = default;
    ALWAYS_INLINE Floats(FloatRegister lanes) : value(lanes) {}
    ALWAYS_INLINE Floats(double each) : value(static_cast<float>(each) - FloatRegister{}) {}

    ALWAYS_INLINE Floats& operator+=(Floats other) {
        value += other.value;
        return *this;
    }
    ALWAYS_INLINE Floats& operator*=(Floats other) {
        value *= other.value;
        return *this;
    }
    ALWAYS_INLINE Floats& operator/=(Floats other) {
        value /= other.value;
        return *this;
    }
};

ALWAYS_INLINE Floats operator+(Floats a, Floats b) {
    return a.value + b.value;
}
ALWAYS_INLINE Floats operator-(Floats a, Floats b) {
    return a.value - b.value;
}
ALWAYS_INLINE Floats operator*(Floats a, Floats b) {
    return a.value * b.value;
}
ALWAYS_INLINE Floats operator/(Floats a, Floats b) {
    return a.value / b.value;
}
ALWAYS_INLINE Floats operator-(Floats a) {
    return -a.value;
}

ALWAYS_INLINE Floats at_least(Floats x, Floats bound) {
    return vector::larger(x.value, bound.value);
}
ALWAYS_INLINE Floats at_most(Floats x, Floats bound) {
    return vector::smaller(x.value, bound.value);
}
ALWAYS_INLINE Floats square_root(Floats x) {
    return vector::root(x.value);
}

// a b + c as for doubles.
ALWAYS_INLINE Floats fused(Floats a, Floats b, Floats c) {
    return vector::multiply_add(a.value, b.value, c.value);
}

namespace vector {

ALWAYS_INLINE FloatBits to_bits(Floats x) {
    return std::bit_cast<FloatBits>(x.value);
}
ALWAYS_INLINE Floats to_floats(FloatBits bits) {
    return std::bit_cast<FloatRegister>(bits);
}

constexpr std::uint32_t FLOAT_SIGN = std::uint32_t{1} << 31;
constexpr int FLOAT_MANTISSA = 23;              // bits
constexpr std::uint32_t FLOAT_BIAS = 127;       // of the exponent
constexpr double FLOAT_ROUNDING = 0x1.8p23;     // adding it rounds to a whole number
constexpr double FLOAT_LARGEST = 87.0;          // e**87 is near the end of the range
constexpr double FLOAT_LN2_HIGH = 0.693359375;  // exact multiples (Cody and Waite 1980)
constexpr double FLOAT_LN2_LOW = -2.12194440054690582e-4;

// (e**r - 1)/r, |r| <= log(2)/2, interpolated at Chebyshev points: relative error of e**r 5e-9.
constexpr double FLOAT_REST_OF_EXP[] = {1.000000010771571,   0.5000000013457768,
                                        0.16666505260407374, 0.04166646500593614,
                                        0.00836914849097491, 0.0013933641038483312};

// 2 artanh(t)/t as a polynomial in t^2 as in `math.hpp`: error of the logarithm 4e-8.
constexpr double FLOAT_ARTANH[] = {2.0000002357976343, 0.6665226672423552, 0.41294909225285686};

struct SplitFloats {
    Floats mantissa, exponent;
};

ALWAYS_INLINE SplitFloats split(Floats x) {
    constexpr std::uint32_t ROOT_HALF = 0x3f3504f3, ONE = FLOAT_BIAS << FLOAT_MANTISSA;
    constexpr std::uint32_t FRACTION = (std::uint32_t{1} << FLOAT_MANTISSA) - 1;
    constexpr std::uint32_t WHOLE = 0x4b000000;  // bits of 2^23, whose last counts 1
    FloatBits bits = to_bits(x) + (ONE - ROOT_HALF);
    return {
        to_floats((bits & FRACTION) + ROOT_HALF),
        to_floats((bits >> FLOAT_MANTISSA) | WHOLE) - (0x1p23 + static_cast<double>(FLOAT_BIAS))};
}

ALWAYS_INLINE Floats log_of(Floats t, Floats exponent) {
    Floats s = t * t;
    Floats series = fused(s, fused(s, FLOAT_ARTANH[2], FLOAT_ARTANH[1]), FLOAT_ARTANH[0]);
    return fused(exponent, LN2_HIGH + LN2_LOW, t * series);
}

}  // namespace vector

ALWAYS_INLINE Floats magnitude(Floats x) {
    return vector::to_floats(vector::to_bits(x) & ~vector::FLOAT_SIGN);
}

ALWAYS_INLINE Floats with_sign(Floats x, Floats y) {
    return vector::to_floats((vector::to_bits(x) & ~vector::FLOAT_SIGN) |
                             (vector::to_bits(y) & vector::FLOAT_SIGN));
}

ALWAYS_INLINE Floats where_less(Floats x, double bound, Floats then, Floats otherwise) {
    return FloatRegister(x.value < Floats(bound).value ? then.value : otherwise.value);
}

// e**x, saturating at the ends of the range.
ALWAYS_INLINE Floats exp(Floats x) {
    using namespace vector;
    x = at_most(at_least(x, -FLOAT_LARGEST), FLOAT_LARGEST);
    Floats shifted = fused(x, INVERSE_LN2, FLOAT_ROUNDING), n = shifted - FLOAT_ROUNDING;
    Floats r = fused(n, -FLOAT_LN2_LOW, fused(n, -FLOAT_LN2_HIGH, x)), s = r * r;
    const double* c = FLOAT_REST_OF_EXP;
    Floats even = fused(s, fused(s, c[4], c[2]), c[0]), odd = fused(s, fused(s, c[5], c[3]), c[1]);
    return fused(r, fused(r, odd, even), 1.0) *
           to_floats((to_bits(shifted) + FLOAT_BIAS) << FLOAT_MANTISSA);
}

ALWAYS_INLINE Floats falling_exp(Floats x) {
    return exp(x);
}

// Natural logarithm of a positive normal number.
ALWAYS_INLINE Floats log(Floats x) {
    auto [mantissa, exponent] = vector::split(x);
    return vector::log_of((mantissa - 1.0) / (mantissa + 1.0), exponent);
}

// Natural logarithms of three, with one division for all.
ALWAYS_INLINE Three<Floats> logs(Floats x, Floats y, Floats z) {
    auto [a, i] = vector::split(x);
    auto [b, j] = vector::split(y);
    auto [c, k] = vector::split(z);
    Floats p = a + 1.0, q = b + 1.0, r = c + 1.0;
    Floats pq = p * q, inverse = 1.0 / (pq * r), rest = r * inverse;
    return {vector::log_of((a - 1.0) * (q * rest), i), vector::log_of((b - 1.0) * (p * rest), j),
            vector::log_of((c - 1.0) * (pq * inverse), k)};
}

}  // namespace gearbox
