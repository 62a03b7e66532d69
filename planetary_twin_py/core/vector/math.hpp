#pragma once

// exp, log, sine and cosine without branches or calls, so that loops over them vectorise.
//
// Relative error below 1e-11 of exp, absolute error below 1e-12 of log; precise_exp and sin_cos are
// accurate to the last digits. No conversion between doubles and 64-bit integers, which AVX2 lacks:
// adding 1.5 * 2^52 rounds to a whole number and leaves it in the low bits.

#include <bit>
#include <cstdint>

#include "vector/lanes.hpp"

namespace gearbox {

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

// Polynomial with these coefficients, lowest first, in x^2 alone: every other one from `LAST` down.
template <int LAST, class Real>
ALWAYS_INLINE Real every_other(const double* coefficient, Real square) {
    Real sum = fused(square, coefficient[LAST], coefficient[LAST - 2]);
#pragma GCC unroll 16
    for (int n = LAST - 4; n >= 0; n -= 2) sum = fused(sum, square, coefficient[n]);
    return sum;
}

// Polynomial with these coefficients, lowest first: even and odd powers apart, which halves the
// latency.
template <class Real, int COUNT>
ALWAYS_INLINE Real polynomial_of(const double (&coefficient)[COUNT], Real x) {
    Real square = x * x;
    Real last = every_other<COUNT - 1>(coefficient, square);
    Real other = every_other<COUNT - 2>(coefficient, square);
    return COUNT % 2 == 1 ? fused(x, other, last) : fused(x, last, other);
}

// Taylor polynomial of e**r, |r| <= log(2)/2, to the last digits.
constexpr double TAYLOR_OF_EXP[] = {
    inverse_factorial(0),  inverse_factorial(1),  inverse_factorial(2),  inverse_factorial(3),
    inverse_factorial(4),  inverse_factorial(5),  inverse_factorial(6),  inverse_factorial(7),
    inverse_factorial(8),  inverse_factorial(9),  inverse_factorial(10), inverse_factorial(11),
    inverse_factorial(12), inverse_factorial(13), inverse_factorial(14)};

// (e**r - 1)/r, interpolated at Chebyshev points: relative error of e**r below 4e-14.
constexpr double REST_OF_EXP[] = {
    1.0000000000000013,     0.499999999997979,      0.1666666666661564,
    0.041666666890980815,   0.00833333336731422,    0.001388882167366507,
    0.00019841190644058747, 2.4876165909124045e-05, 2.7632642126375148e-06};

// x = n log(2) + r, and 2**n.
template <class Real>
struct Reduced {
    Real rest, scale;
};

template <class Real>
ALWAYS_INLINE Reduced<Real> reduce(Real x) {
    Real shifted = fused(x, INVERSE_LN2, ROUNDING);
    Real n = shifted - ROUNDING;
    return {fused(n, -LN2_LOW, fused(n, -LN2_HIGH, x)),
            from_bits<Real>((to_bits(shifted) + BIAS) << MANTISSA)};
}

template <class Real>
ALWAYS_INLINE Real short_exp(Real x) {
    Reduced<Real> reduced = reduce(x);
    Real r = reduced.rest;
    return fused(r, polynomial_of(REST_OF_EXP, r), 1.0) * reduced.scale;
}

}  // namespace vector

// e**x for any finite x, saturating at the ends of the double range.
template <class Real>
ALWAYS_INLINE Real exp(Real x) {
    return vector::short_exp(
        at_most(at_least(x, -vector::LARGEST_EXPONENT), vector::LARGEST_EXPONENT));
}

// The same for x <= 700.
template <class Real>
ALWAYS_INLINE Real falling_exp(Real x) {
    return vector::short_exp(at_least(x, -vector::LARGEST_EXPONENT));
}

// e**x to the last digits for x <= 0, saturating at the end of the double range.
template <class Real>
ALWAYS_INLINE Real precise_exp(Real x) {
    vector::Reduced<Real> reduced = vector::reduce(at_least(x, -vector::LARGEST_EXPONENT));
    return vector::polynomial_of(vector::TAYLOR_OF_EXP, reduced.rest) * reduced.scale;
}

struct SinCos {
    double sine, cosine;
};

// Sine and cosine of -1e5 <= x <= 1e5.
ALWAYS_INLINE SinCos sin_cos(double x) {
    using namespace vector;
    double shifted = fused(x, INVERSE_RIGHT_ANGLE, ROUNDING);
    double n = shifted - ROUNDING;
    double r =
        fused(n, -RIGHT_ANGLE_LOW, fused(n, -RIGHT_ANGLE_MIDDLE, fused(n, -RIGHT_ANGLE_HIGH, x)));
    double q = r * r;
    double s = -inverse_factorial(15);
    s = fused(q, s, inverse_factorial(13));
    s = fused(q, s, -inverse_factorial(11));
    s = fused(q, s, inverse_factorial(9));
    s = fused(q, s, -inverse_factorial(7));
    s = fused(q, s, inverse_factorial(5));
    s = fused(q, s, -inverse_factorial(3));
    s = fused(r * q, s, r);
    double c = inverse_factorial(16);
    c = fused(q, c, -inverse_factorial(14));
    c = fused(q, c, inverse_factorial(12));
    c = fused(q, c, -inverse_factorial(10));
    c = fused(q, c, inverse_factorial(8));
    c = fused(q, c, -inverse_factorial(6));
    c = fused(q, c, inverse_factorial(4));
    c = fused(q, c, -inverse_factorial(2));
    c = fused(q, c, 1.0);
    // Odd quarters swap both; the sign bits come from the two last bits of n and of n + 1.
    std::uint64_t quarter = std::bit_cast<std::uint64_t>(shifted);
    constexpr int TO_SIGN = 62;
    bool odd = quarter & 1;
    std::uint64_t sine = std::bit_cast<std::uint64_t>(odd ? c : s);
    std::uint64_t cosine = std::bit_cast<std::uint64_t>(odd ? s : c);
    return {std::bit_cast<double>(sine ^ ((quarter << TO_SIGN) & SIGN)),
            std::bit_cast<double>(cosine ^ (((quarter + 1) << TO_SIGN) & SIGN))};
}

namespace vector {

// 2 artanh(t)/t as a polynomial in t^2, |t| <= (sqrt(2) - 1)/(sqrt(2) + 1), interpolated at
// Chebyshev points: error of the logarithm below 1e-14.
constexpr double ARTANH[] = {1.999999999999947,  0.6666666667963782,  0.39999994875889094,
                             0.2857216766407459, 0.22174190918339937, 0.1960889776138223};

// Mantissa in [sqrt(1/2), sqrt(2)), where the series is shortest, and exponent.
template <class Real>
struct Split {
    Real mantissa, exponent;
};

template <class Real>
ALWAYS_INLINE Split<Real> split(Real x) {
    constexpr std::uint64_t TO_ROOT_HALF = 0x95F619980C433;  // from the mantissa of sqrt(2) to 2
    constexpr std::uint64_t FRACTION = (std::uint64_t{1} << MANTISSA) - 1;
    constexpr std::uint64_t ONE = BIAS << MANTISSA;
    constexpr std::uint64_t WHOLE = 0x4330000000000000;  // bits of 2^52, whose last counts 1
    auto bits = to_bits(x) + TO_ROOT_HALF;
    return {from_bits<Real>((bits & FRACTION) + (ONE - TO_ROOT_HALF)),
            from_bits<Real>((bits >> MANTISSA) | WHOLE) - (0x1p52 + static_cast<double>(BIAS))};
}

// 2 artanh(t) + exponent log(2).
template <class Real>
ALWAYS_INLINE Real log_of(Real t, Real exponent) {
    return fused(exponent, LN2_HIGH + LN2_LOW, t * polynomial_of(ARTANH, t * t));
}

}  // namespace vector

// Natural logarithm of a positive normal number.
template <class Real>
ALWAYS_INLINE Real log(Real x) {
    auto [mantissa, exponent] = vector::split(x);
    return vector::log_of((mantissa - 1.0) / (mantissa + 1.0), exponent);
}

// x**y for x >= 0 to a relative error of 1e-11; for x = 0 and y > 0 not quite 0.
ALWAYS_INLINE double power(double x, double y) {
    return exp(y * log(x));
}

template <class Real>
struct Three {
    Real first, second, third;
};

// Natural logarithms of three positive normal numbers, with one division for all.
template <class Real>
ALWAYS_INLINE Three<Real> logs(Real x, Real y, Real z) {
    auto [a, i] = vector::split(x);
    auto [b, j] = vector::split(y);
    auto [c, k] = vector::split(z);
    Real p = a + 1.0, q = b + 1.0, r = c + 1.0;
    Real pq = p * q, inverse = 1.0 / (pq * r), rest = r * inverse;  // the latter 1/(p q)
    return {vector::log_of((a - 1.0) * (q * rest), i), vector::log_of((b - 1.0) * (p * rest), j),
            vector::log_of((c - 1.0) * (pq * inverse), k)};
}

}  // namespace gearbox
