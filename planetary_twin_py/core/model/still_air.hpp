#pragma once

// Heat from a wall to still air: free convection of a vertical plate (Churchill and Chu 1975, Int.
// J. Heat Mass Transfer 18, 1323-1329, laminar and turbulent) and radiation to surroundings at the
// temperature of the air.
//
// Nu = (0.825 + 0.387 Ra^(1/6)/(1 + (0.492/Pr)^(9/16))^(8/27))^2, Ra = g (Tw - Ta) H^3/(Tf nu a),
// with the properties at the mean temperature Tf of wall and air.

#include <cmath>

#include "vector/math.hpp"

namespace gearbox {

constexpr double GRAVITY = 9.80665, STEFAN_BOLTZMANN = 5.670374e-8;

struct Air {
    double viscosity;     // kinematic [m^2/s]
    double diffusivity;   // thermal [m^2/s]
    double conductivity;  // [W/(m K)]
};

// Air at atmospheric pressure at 200, 250, ... 500 K (Incropera, DeWitt, Bergman and Lavine 2007,
// Fundamentals of Heat and Mass Transfer, table A.4), linear between.
constexpr double COLDEST_AIR = 200.0, PER_AIR = 50.0;
constexpr Air AIR[] = {
    {7.590e-6, 10.3e-6, 18.1e-3}, {11.44e-6, 15.9e-6, 22.3e-3}, {15.89e-6, 22.5e-6, 26.3e-3},
    {20.92e-6, 29.9e-6, 30.0e-3}, {26.41e-6, 38.3e-6, 33.8e-3}, {32.39e-6, 47.2e-6, 37.3e-3},
    {38.79e-6, 56.7e-6, 40.7e-3},
};
constexpr int AIRS = sizeof(AIR) / sizeof(AIR[0]);

inline Air air_at(double temperature) {
    const double place = (temperature - COLDEST_AIR) / PER_AIR;
    const double row = at_most(at_least(std::floor(place), 0.0), AIRS - 2.0);
    const Air &low = AIR[static_cast<int>(row)], &high = AIR[static_cast<int>(row) + 1];
    const double share = place - row;
    return {low.viscosity + share * (high.viscosity - low.viscosity),
            low.diffusivity + share * (high.diffusivity - low.diffusivity),
            low.conductivity + share * (high.conductivity - low.conductivity)};
}

struct Convection {
    double rayleigh, nusselt;  // [-]
    double coefficient;        // [W/(m^2 K)]
};

// Free convection of a vertical plate; temperatures [K], height [m].
inline Convection free_convection(double wall, double air, double height) {
    const double film = 0.5 * (wall + air);
    const Air properties = air_at(film);
    const double prandtl = properties.viscosity / properties.diffusivity;
    const double rayleigh = GRAVITY * std::abs(wall - air) / film * height * height * height /
                            (properties.viscosity * properties.diffusivity);
    const double share =
        power(1.0 + power(0.492 / prandtl, 9.0 / 16.0), -8.0 / 27.0) * power(rayleigh, 1.0 / 6.0);
    const double root = 0.825 + 0.387 * share;
    const double nusselt = root * root;
    return {rayleigh, nusselt, nusselt * properties.conductivity / height};
}

// (Tw^4 - Ta^4)/(Tw - Ta) times emissivity and constant [W/(m^2 K)].
inline double radiation(double wall, double air, double emissivity) {
    return emissivity * STEFAN_BOLTZMANN * (wall + air) * (wall * wall + air * air);
}

}  // namespace gearbox
