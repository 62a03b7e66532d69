#pragma once

// exp, log, sine and cosine without branches or calls, so that loops over them vectorise.
//
// Relative error below 1e-11 of exp, absolute error below 1e-12 of log; precise_exp and sin_cos are
// exact to the last digits. No fused multiplication, and no conversion between doubles and 64-bit
// integers, which AVX2 lacks: adding 1.5 * 2^52 rounds to a whole number and leaves it in the low
// bits. So every processor gives the same bits.

#include <bit>
#include <cstdint>

namespace gearbox {

// The larger (smaller) of both; `x` if that is NaN, so that an error is not lost in a bound.
constexpr double at_least(double x, double bound) { return bound > x ? bound : x; }
constexpr double at_most(double x, double bound) { return bound < x ? bound : x; }

namespace vector {

constexpr double LN2_HIGH = 0.693147180369123816490;
constexpr double LN2_LOW = 1.90821492927058770002e-10;
constexpr double INVERSE_LN2 = 1.4426950408889634;
// pi/2 in parts whose multiples by a whole number are exact (Cody and Waite 1980).
constexpr double RIGHT_ANGLE_HIGH = 1.57079632673412561417;
constexpr double RIGHT_ANGLE_MIDDLE = 6.07710050630396597660e-11;
constexpr double RIGHT_ANGLE_LOW = 2.02226624879595063154e-21;
constexpr double INVERSE_RIGHT_ANGLE = 0.63661977236758134308;
constexpr double ROUNDING = 0x1.8p52;
constexpr double LARGEST_EXPONENT = 700.0;  // e**700 is near the end of the double range
constexpr int MANTISSA = 52;                // bits
constexpr std::uint64_t BIAS = 1023;        // of the exponent

constexpr double inverse_factorial(int n) {
    double product = 1.0;
    for (int i = 2; i <= n; ++i) product *= i;
    return 1.0 / product;
}

// Taylor polynomial of e**r, |r| <= log(2)/2, of degree N.
template <int N>
constexpr double taylor_of_exp(double r) {
    double p = inverse_factorial(N);
#pragma GCC unroll 16
    for (int n = N - 1; n >= 0; --n) p = inverse_factorial(n) + r * p;
    return p;
}

template <int DEGREE>
inline double exp(double x) {
    double shifted = x * INVERSE_LN2 + ROUNDING;
    double n = shifted - ROUNDING;
    double r = (x - n * LN2_HIGH) - n * LN2_LOW;
    double scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + BIAS)
                                         << MANTISSA);
    return taylor_of_exp<DEGREE>(r) * scale;
}

}  // namespace vector

// e**x for any finite x, saturating at the ends of the double range.
inline double exp(double x) {
    return vector::exp<11>(
        at_most(at_least(x, -vector::LARGEST_EXPONENT), vector::LARGEST_EXPONENT));
}

// e**x to the last digits for x <= 0, saturating at the end of the double range.
inline double precise_exp(double x) {
    return vector::exp<14>(at_least(x, -vector::LARGEST_EXPONENT));
}

struct SinCos {
    double sine, cosine;
};

// Sine and cosine of 0 <= x <= 1e5.
inline SinCos sin_cos(double x) {
    using namespace vector;
    double shifted = x * INVERSE_RIGHT_ANGLE + ROUNDING;
    double n = shifted - ROUNDING;
    double r = ((x - n * RIGHT_ANGLE_HIGH) - n * RIGHT_ANGLE_MIDDLE) - n * RIGHT_ANGLE_LOW;
    double q = r * r;
    double s = -inverse_factorial(15);
    s = inverse_factorial(13) + q * s;
    s = -inverse_factorial(11) + q * s;
    s = inverse_factorial(9) + q * s;
    s = -inverse_factorial(7) + q * s;
    s = inverse_factorial(5) + q * s;
    s = -inverse_factorial(3) + q * s;
    s = r + r * q * s;
    double c = inverse_factorial(16);
    c = -inverse_factorial(14) + q * c;
    c = inverse_factorial(12) + q * c;
    c = -inverse_factorial(10) + q * c;
    c = inverse_factorial(8) + q * c;
    c = -inverse_factorial(6) + q * c;
    c = inverse_factorial(4) + q * c;
    c = -inverse_factorial(2) + q * c;
    c = 1.0 + q * c;
    // Odd quarters swap both; the sign bits come from the two last bits of n and of n + 1.
    std::uint64_t quarter = std::bit_cast<std::uint64_t>(shifted);
    constexpr int TO_SIGN = 62;
    constexpr std::uint64_t SIGN = std::uint64_t{1} << 63;
    bool odd = quarter & 1;
    std::uint64_t sine = std::bit_cast<std::uint64_t>(odd ? c : s);
    std::uint64_t cosine = std::bit_cast<std::uint64_t>(odd ? s : c);
    return {std::bit_cast<double>(sine ^ ((quarter << TO_SIGN) & SIGN)),
            std::bit_cast<double>(cosine ^ (((quarter + 1) << TO_SIGN) & SIGN))};
}

namespace vector {

struct Split {
    double mantissa, exponent;
};

// Mantissa in [sqrt(1/2), sqrt(2)), where the series is shortest, and exponent.
inline Split split(double x) {
    constexpr std::uint64_t TO_ROOT_HALF = 0x95F619980C433;
    constexpr std::uint64_t WHOLE = 0x4330000000000000;  // bits of 2^52, the low ones count
    std::uint64_t bits = std::bit_cast<std::uint64_t>(x);
    std::uint64_t exponent = (bits + TO_ROOT_HALF) >> MANTISSA;
    double mantissa = std::bit_cast<double>(bits - ((exponent - BIAS) << MANTISSA));
    return {mantissa,
            std::bit_cast<double>(exponent | WHOLE) - (0x1p52 + static_cast<double>(BIAS))};
}

// 2 artanh(t) + exponent log(2).
inline double log_of(double t, double exponent) {
    double q = t * t;
    double series = 1.0 / 15.0;
    series = 1.0 / 13.0 + q * series;
    series = 1.0 / 11.0 + q * series;
    series = 1.0 / 9.0 + q * series;
    series = 1.0 / 7.0 + q * series;
    series = 1.0 / 5.0 + q * series;
    series = 1.0 / 3.0 + q * series;
    series = 1.0 + q * series;
    return 2.0 * t * series + exponent * (LN2_HIGH + LN2_LOW);
}

}  // namespace vector

// Natural logarithm of a positive normal number.
inline double log(double x) {
    auto [mantissa, exponent] = vector::split(x);
    return vector::log_of((mantissa - 1.0) / (mantissa + 1.0), exponent);
}

}  // namespace gearbox
