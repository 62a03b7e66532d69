#pragma once

// Rolling resistance of a film: the force on both surfaces by the pressure at the inlet.
//
// Goksem and Hargreaves 1978, J. Lubr. Technol. 100, 346, isothermal line contact: F_R = 4.318 (G
// U)^0.658 W^0.0126 R L/alpha with the groups of `film.hpp`. The power loss is F_R |u1 + u2| with
// the surface speeds u1 and u2. It increases with the speed where traction no longer does: the
// rising end of a Stribeck curve.

#include "vector/math.hpp"

namespace gearbox {

constexpr double ROLLING_COEFFICIENT = 4.318, ROLLING_SPEED = 0.658, ROLLING_LOAD = 0.0126;

// Force F_R [N] on each surface, from R L/alpha [N] and the logarithms of U, G and W.
template <class Real>
ALWAYS_INLINE Real rolling_resistance(Real size, Real log_speed_group, double log_material_group,
                                      Real log_load_group) {
    Real groups =
        ROLLING_SPEED * (log_speed_group + log_material_group) + ROLLING_LOAD * log_load_group;
    return ROLLING_COEFFICIENT * size * exp(groups);
}

}  // namespace gearbox
