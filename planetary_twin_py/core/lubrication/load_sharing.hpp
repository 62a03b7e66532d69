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

// Share X of the load that the film carries [-], from the logarithm of the lambda ratio, and that
// of the film over the thinnest one.
//
// A film thinner than that carries less in proportion. So friction near rest is that of the
// boundary: the fit alone would change it by per cents with each decade of the speed, and without
// limit in its slope.
template <class Real>
ALWAYS_INLINE Real film_share(Real log_lambda, Real log_thickness) {
    Real share = exp(SHARE_EXPONENT * log_lambda + at_most(log_thickness, 0.0));
    return at_most(SHARE_COEFFICIENT * share, 1.0);
}

}  // namespace gearbox
