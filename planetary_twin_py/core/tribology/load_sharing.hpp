#pragma once

// Load sharing of film and asperities in mixed lubrication.
//
// mu = X mu_film + (1 - X) mu_boundary, with the film's share X = 0.82 lambda^0.28, at most 1: a
// fit in common use for gears (no primary source is at hand). Unlike Greenwood and Tripp's
// asperities, which carry a few per cent of the load of a gear at lambda = 0, it tends to boundary
// friction as the film vanishes.

#include "vector/math.hpp"

namespace gearbox {

constexpr double SHARE_COEFFICIENT = 0.82, SHARE_EXPONENT = 0.28;

// Share X of the load that the film carries [-], from the logarithm of the lambda ratio.
template <class Real>
ALWAYS_INLINE Real film_share(Real log_lambda) {
    return at_most(SHARE_COEFFICIENT * exp(SHARE_EXPONENT * log_lambda), 1.0);
}

}  // namespace gearbox
