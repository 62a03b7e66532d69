#pragma once

// Elastic line contact (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.43).

#include <numbers>

#include "vector/lanes.hpp"

namespace gearbox {

// Half-width b [m] of the contact under a normal load [N]; reduced radius of curvature R,
// 1/R = 1/R1 +- 1/R2 [m]; length of the contact L [m]; E*, 1/E* = (1-nu1^2)/E1 + (1-nu2^2)/E2 [Pa].
template <class Real>
ALWAYS_INLINE Real half_width(Real load, Real radius, double face_width, double contact_modulus) {
    double stiffness = std::numbers::pi * face_width * contact_modulus;
    return square_root(4.0 * load * radius / stiffness);
}

}  // namespace gearbox
