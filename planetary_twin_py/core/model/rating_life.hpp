#pragma once

// Damage of a rolling bearing: turns over its rating life (ISO 281:2007).

#include <numbers>

#include "lubrication/oil.hpp"
#include "model/durability.hpp"
#include "vector/math.hpp"

namespace gearbox {

// Ratio of the viscosity of the oil to that which a bearing wants at this speed [1/s], within the
// range from 0.1 to 4 for which the factor is given; eq. 27 and 28, in mm^2/s, mm and 1/min.
inline double viscosity_ratio(double kinematic, double diameter, double turns_per_second) {
    constexpr double FAST = 1000.0;
    const double speed = at_least(60.0 * turns_per_second, 1e-6), size = 1e3 * diameter;
    const double wanted = speed < FAST ? 45000.0 * power(speed, -0.83) * power(size, -0.5)
                                       : 4500.0 * power(speed, -0.5) * power(size, -0.5);
    return at_most(at_least(1e6 * kinematic / wanted, 0.1), 4.0);
}

// Factor a_ISO of the life for lubrication and contamination, eq. 31 to 36, at most 50.
inline double life_modification(const SeatRating& seat, double load, double kappa) {
    const double relative = seat.limit / at_least(load, 1e-9 * seat.rating);
    double factor, power_of_kappa;
    if (kappa <= 0.4)
        factor = seat.balls ? 2.2649 : 1.3993, power_of_kappa = 0.054381;
    else
        factor = seat.balls ? 1.9987 : 1.2348, power_of_kappa = kappa <= 1.0 ? 0.19087 : 0.071739;
    const double lubrication = factor * power(kappa, -power_of_kappa);
    const double left = seat.balls
                            ? 1.0 - power(2.5671 - lubrication, 0.83) * power(relative, 1.0 / 3.0)
                            : 1.0 - (1.5859 - lubrication) * power(relative, 0.4);
    if (left <= 0.0) return 50.0;
    return at_most(0.1 * power(left, seat.balls ? -9.3 : -9.185), 50.0);
}

// Turns over life per second, under a load [N].
inline double bearing_damage(const SeatRating& seat, const Oil& oil, double load,
                             double turns_per_second) {
    const double share = load / seat.rating;
    const double life = seat.balls ? share * share * share : power(share, seat.exponent);
    const double basic = 1e-6 * turns_per_second * life;
    if (seat.limit == 0.0) return basic;
    const double kappa = viscosity_ratio(oil.kinematic, seat.diameter, turns_per_second);
    return basic / life_modification(seat, load, kappa);
}

}  // namespace gearbox
