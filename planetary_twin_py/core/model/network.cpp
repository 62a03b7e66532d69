#include "model/network.hpp"

#include <algorithm>
#include <cmath>

#include "lubrication/schlenk.hpp"
#include "model/still_air.hpp"
#include "vector/math.hpp"
#include "vector/symmetric_eigen.hpp"

namespace gearbox {

namespace {

constexpr double LN10 = 2.302585092994046;
constexpr double THICKEST = 1e9;  // [mm^2/s] far below the pour point
constexpr double SHORT = 0.25;    // rate times time below which series are exact
constexpr int SERIES = 12;        // terms

// (1 - e^-z)/z and its mean over the time, (1 - (1 - e^-z)/z)/z, without cancellation.
struct Response {
    double at_end, mean;
};

Response response(double z) {
    if (z >= SHORT) {
        const double first = (1.0 - precise_exp(-z)) / z;
        return {first, (1.0 - first) / z};
    }
    double term = 1.0, first = 0.0, second = 0.0;  // (-z)^n/(n + 1)!
    for (int n = 0; n < SERIES; ++n) {
        first += term;
        second += term / (n + 2.0);
        term *= -z / (n + 2.0);
    }
    return {first, second};
}

bool cooler_is_open(const Network& network) {
    return network.cooling > 0.0 && network.temperature[OIL_NODE] > network.opens;
}

// Conductance from each node to its boundary [W/K], and the temperature of that [K].
struct Boundaries {
    double conductance[NODES], temperature[NODES];
};

Boundaries boundaries(const Network& network) {
    Boundaries found{};
    found.conductance[HOUSING_NODE] = to_ambient_air(network);
    found.temperature[HOUSING_NODE] = network.ambient;
    if (cooler_is_open(network)) found.conductance[OIL_NODE] = network.cooling;
    found.temperature[OIL_NODE] = network.opens;
    return found;
}

// Rates of the network scaled to be symmetric, C^-1/2 K C^-1/2: its eigenvectors by columns.
struct Relaxation {
    double shape[NODES][BODIES];
    double rate[NODES];   // [1/s]
    double scale[NODES];  // 1/sqrt(C)
};

void relax(const Network& network, const Boundaries& outside, Relaxation& out) {
    for (int i = 0; i < NODES; ++i) out.scale[i] = 1.0 / std::sqrt(network.capacity[i]);
    for (int i = 0; i < NODES; ++i) {
        double total = outside.conductance[i];
        for (int j = 0; j < NODES; ++j) {
            if (j == i) continue;
            total += network.conductance[i][j];
            out.shape[i][j] = -network.conductance[i][j] * out.scale[i] * out.scale[j];
        }
        out.shape[i][i] = total / network.capacity[i];
    }
    symmetric_eigen(out.shape, NODES, out.rate);
}

// Mean of the temperatures of both gears of a mesh of this kind [K].
double of_mesh(const double* temperature, int kind) {
    return 0.5 * (temperature[PLANETS_NODE] + temperature[kind == 0 ? SUN_NODE : RING_NODE]);
}

// Logarithm of the dynamic viscosity in Pa s.
double log_viscosity(const OilAtTemperature& oil, double temperature) {
    const double level = oil.level - oil.slope * log(temperature / oil.reference) / LN10;
    const double highest = log(log(THICKEST) / LN10) / LN10;
    const double kinematic = exp(exp(std::min(level, highest) * LN10) * LN10) - 0.7;
    return log(oil.density * 1e-6 * kinematic);
}

}  // namespace

double to_ambient_air(const Network& network) {
    if (network.to_ambient > 0.0) return network.area * network.to_ambient;
    const double wall = network.temperature[HOUSING_NODE];
    return network.area * (free_convection(wall, network.ambient, network.height).coefficient +
                           radiation(wall, network.ambient, network.emissivity));
}

void advance_network(Network& network, const double* heat, double duration) {
    double inflow[NODES] = {};  // net, at the start [W]
    double* temperature = network.temperature;
    for (int s = 0; s < HEATS; ++s) {
        network.power[s] = heat[s] / duration;
        for (int i = 0; i < NODES; ++i) inflow[i] += network.share[s][i] * network.power[s];
    }
    const Boundaries outside = boundaries(network);
    for (int i = 0; i < NODES; ++i) {
        inflow[i] += outside.conductance[i] * (outside.temperature[i] - temperature[i]);
        for (int j = 0; j < NODES; ++j)
            inflow[i] += network.conductance[i][j] * (temperature[j] - temperature[i]);
    }
    Relaxation modes;
    relax(network, outside, modes);
    double rise[NODES] = {}, mean_rise[NODES] = {};
    for (int m = 0; m < NODES; ++m) {
        double push = 0.0;
        for (int i = 0; i < NODES; ++i) push += modes.shape[i][m] * modes.scale[i] * inflow[i];
        const Response found = response(std::max(modes.rate[m], 0.0) * duration);
        for (int i = 0; i < NODES; ++i) {
            const double share = modes.shape[i][m] * modes.scale[i] * push * duration;
            rise[i] += share * found.at_end;
            mean_rise[i] += share * found.mean;
        }
    }
    auto given_away = [&](int i) {
        const double mean = temperature[i] + mean_rise[i];
        return outside.conductance[i] * (mean - outside.temperature[i]) * duration;
    };
    network.released += given_away(HOUSING_NODE);
    network.cooled += given_away(OIL_NODE);
    for (int i = 0; i < NODES; ++i) temperature[i] += rise[i];
}

bool has_moved(const Network& network) {
    for (int i = OIL_NODE; i <= RING_NODE; ++i)
        if (std::abs(network.temperature[i] - network.lubricating[i]) >= network.dead_band)
            return true;
    return false;
}

void warm_oil(Network& network, Oil& oil) {
    std::copy_n(network.temperature, NODES, network.lubricating);
    const OilAtTemperature& law = network.oil;
    const double of_oil = log_viscosity(law, network.lubricating[OIL_NODE]);
    oil.log_speed_group = law.log_speed_group + of_oil;
    oil.traction.log_root = law.log_root + of_oil;
    oil.shear_thinning.log_shear_time = law.log_shear_time + of_oil;
    oil.log_schlenk = law.log_schlenk + SCHLENK_VISCOSITY * of_oil;
    oil.kinematic = exp(of_oil) / law.density;
    for (int kind = 0; kind < KINDS; ++kind) {
        oil.temperature[kind] = of_mesh(network.lubricating, kind);
        oil.log_viscosity[kind] = log_viscosity(law, oil.temperature[kind]) - of_oil;
    }
}

}  // namespace gearbox
