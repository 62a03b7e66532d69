#pragma once

// Temperatures of a gearbox as a network of nodes with heat capacities.
//
// C_i dT_i/dt = P_i + sum G_ij (T_j - T_i), beside these the housing loses heat to the ambient air,
// and the oil to a cooler whose thermostat opens in proportion: capacity (T - opens), if positive.

#include <cstdint>

#include "capacities.hpp"
#include "lubrication/oil.hpp"

namespace gearbox {

constexpr int OIL_NODE = 0, SUN_NODE = 1, PLANETS_NODE = 2, RING_NODE = 3, HOUSING_NODE = 4,
              NODES = 5;

// Constants of an oil without its viscosity: Walther's equation log10 log10(nu + 0.7) = level -
// slope log10(T/reference) in mm^2/s, and logarithms of `Oil` without their share of the viscosity.
struct alignas(64) OilAtTemperature {
    double level, slope, reference;  // [-], [-], [K]
    double density;                  // [kg/m^3]
    double log_speed_group, log_root, log_shear_time, log_schlenk;
};

struct alignas(64) Network {
    double capacity[NODES];                        // [J/K]
    alignas(64) double conductance[NODES][NODES];  // between nodes, symmetric [W/K]
    alignas(64) double share[HEATS][NODES];        // of the heat of each source that a node takes
    double area, height, emissivity;               // of the housing [m^2], [m], [-]
    double to_ambient;  // coefficient of the housing [W/(m^2 K)]; 0: still air
    double cooling;     // of the cooler [W/K]
    double opens;       // temperature of the oil at which the cooler opens [K]
    double dead_band;   // change of a temperature without another viscosity [K]
    OilAtTemperature oil;
    double ambient;             // [K]
    double temperature[NODES];  // [K]
    double lubricating[NODES];  // those at which the viscosity was computed [K]
    double power[HEATS];        // mean of the last step by source [W]
    double released;            // to the ambient air since the start [J]
    double cooled;              // by the cooler since the start [J]
};

// Conductance from the housing to the ambient air at the present temperatures [W/K].
double to_ambient_air(const Network& network);

// Take `heat` [J] of each source (HEATS,) at constant power in `duration` [s].
//
// This is exact for constant coefficients: those of the air and of the cooler are taken at the
// start.
void advance_network(Network& network, const double* heat, double duration);

// Whether a temperature of oil or gears has moved by the dead band since the last `warm_oil`.
bool has_moved(const Network& network);

// Set the viscosity of `oil`: in bearings and churning that of the oil node, in the meshes that at
// the mean temperature of their gears.
void warm_oil(Network& network, Oil& oil);

}  // namespace gearbox
