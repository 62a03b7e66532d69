#pragma once

// Friction torque of a rolling bearing (Palmgren 1959; Harris, Rolling Bearing Analysis).
//
// Without load M0 = 1e-7 f0 (nu n)^(2/3) dm^3, or 160e-7 f0 dm^3 where nu n < 2000 (here 2000^(2/3)
// = 158.7, so that M0 is continuous); by load M1 = f1 F dm, so f1 is half a coefficient of friction
// at dm/2. (N mm, mm, mm^2/s and rpm there; SI here.) f0 is 1.5 to 2 for deep-groove ball bearings
// in an oil bath, 2 to 3 for cylindrical rollers, 6 to 12 for needles; f1 some 2e-4 to 1e-3, of
// cylindrical rollers 2e-4 to 4e-4.

#include <cmath>
#include <numbers>

#include "vector/math.hpp"

namespace gearbox {

constexpr double SLOW_BEARING = 2000.0;  // [mm^2/s rpm] below it M0 follows neither oil nor speed

// M0 + M1 [N m], never negative; `no_load_factor` f0 dm^3 [m^3], `load_factor` f1 dm [m], viscosity
// [m^2/s], speed of one ring against the other [rad/s], load [N].
inline double bearing_torque(double no_load_factor, double load_factor, double kinematic_viscosity,
                             double speed, double load) {
    double product = 1e6 * kinematic_viscosity * std::abs(speed) * 30.0 / std::numbers::pi;
    return 0.1 * no_load_factor * power(at_least(product, SLOW_BEARING), 2.0 / 3.0) +
           load_factor * load;
}

}  // namespace gearbox
