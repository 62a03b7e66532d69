#pragma once

// Statistics of rough surfaces in contact (Greenwood and Tripp 1970).
//
// F_n(lambda) = 1/sqrt(2 pi) * integral from lambda to infinity of (s-lambda)^n exp(-s^2/2) ds.
// Both functions are given as exp of a quartic fitted to that integral: relative error below 3e-4
// for 0 <= lambda <= 4, positive and decreasing up to LARGEST_LAMBDA.

#include "vector/math.hpp"

namespace gearbox {

constexpr double LARGEST_LAMBDA = 6.0;  // no asperity load beyond: F_5/2(6) is 6e-13

// F_2 [-], proportional to the area of the asperities in contact.
template <class Real>
ALWAYS_INLINE Real contact_area_function(Real lambda_ratio) {
    Real x = at_most(lambda_ratio, LARGEST_LAMBDA);
    return exp((((0.00130501 * x - 0.0241815) * x - 0.275167) * x - 1.59436) * x - 0.693356);
}

// F_5/2 [-], proportional to the load on the asperities.
template <class Real>
ALWAYS_INLINE Real contact_load_function(Real lambda_ratio) {
    Real x = at_most(lambda_ratio, LARGEST_LAMBDA);
    return exp((((0.00117382 * x - 0.0230728) * x - 0.270566) * x - 1.74266) * x - 0.483601);
}

}  // namespace gearbox
