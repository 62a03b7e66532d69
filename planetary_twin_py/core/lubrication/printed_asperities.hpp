#pragma once

// The asperity functions as Salagianni et al. 2017 print them in their appendix.
//
// Polynomials with three decimals: the area function is negative above lambda = 1.90, the load
// function rises above 1.91, and both drop to zero at 3. For their definition see `asperities.hpp`.

#include "vector/lanes.hpp"

namespace gearbox {

constexpr double LAST_PRINTED = 3.0;  // lambda ratio beyond which both are zero

// F_2 [-] at the lambda ratio x.
template <class Real>
ALWAYS_INLINE Real printed_area_function(Real x) {
    Real value = ((((-0.002 * x + 0.028) * x - 0.173) * x + 0.526) * x - 0.804) * x + 0.5;
    return where_less(-x, -LAST_PRINTED, Real{}, value);
}

// F_5/2 [-] at the lambda ratio x.
template <class Real>
ALWAYS_INLINE Real printed_load_function(Real x) {
    Real value = ((((-0.004 * x + 0.057) * x - 0.296) * x + 0.784) * x - 1.078) * x + 0.617;
    return where_less(-x, -LAST_PRINTED, Real{}, value);
}

}  // namespace gearbox
