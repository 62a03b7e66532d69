#pragma once

// Boundary friction of the asperities (Salagianni et al. 2017, eqs. (7)-(11)).
//
// With the mean asperity pressure P_m = W_a/A_a (9), the friction f_b = (tau0 + eps P_m) A_a of (7)
// and (8) is tau0 A_a + eps W_a, without a division by A_a, which vanishes at large lambda. Both
// A_a (10) and W_a (11) are proportional to the apparent area A = 2 b L.

#include "lubrication/asperities.hpp"
#include "lubrication/constants.hpp"
#include "lubrication/printed_asperities.hpp"

namespace gearbox {

// Boundary friction per apparent area, f_b/A [Pa]; with `printed` asperity functions or not.
template <class Real>
ALWAYS_INLINE Real boundary_shear(const Asperities& asperities, bool printed, Real lambda_ratio) {
    Real area = printed ? printed_area_function(lambda_ratio) : contact_area_function(lambda_ratio);
    Real pressure =
        printed ? printed_load_function(lambda_ratio) : contact_load_function(lambda_ratio);
    return asperities.shear_stress * (area * asperities.area_factor) +
           asperities.pressure_coefficient * (pressure * asperities.pressure_factor);
}

}  // namespace gearbox
