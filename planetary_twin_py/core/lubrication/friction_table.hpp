#pragma once

// A friction coefficient from a table of measured or computed values.
//
// Interpolation is linear in the logarithms of the quantities, extrapolation constant. The
// coefficient includes boundary friction; the sign of the friction is that of sliding, as with all
// laws.

#include "lubrication/contact.hpp"
#include "vector/math.hpp"

namespace gearbox {

// A friction coefficient [-], and its derivative with respect to the logarithm of the sliding
// speed.
template <class Real>
struct TabulatedFriction {
    Real coefficient, growth;
};

namespace table {

// A position between two values: `weight` of the second.
struct Cell {
    std::int64_t first;
    double weight, per_logarithm;
};

inline Cell cell_of(const FrictionTable& table, int axis, double logarithm) {
    const std::int64_t size = table.size[axis];
    const double* knot = table.knot[axis];
    if (size == 1) return {0, 0.0, 0.0};
    std::int64_t first = 0;
    while (first < size - 2 && logarithm >= knot[first + 1]) ++first;
    double length = knot[first + 1] - knot[first], weight = (logarithm - knot[first]) / length;
    if (weight <= 0.0) return {first, 0.0, 0.0};
    if (weight >= 1.0) return {first, 1.0, 0.0};
    return {first, weight, 1.0 / length};
}

// Linear interpolation in the axes from `axis` on; `place` is the index of the axes before.
inline double between(const FrictionTable& table, const Cell* cell, int axis, int axes,
                      std::int64_t place) {
    if (axis == axes) return table.coefficient[place];
    place = place * table.size[axis] + cell[axis].first;
    double low = between(table, cell, axis + 1, axes, place);
    if (cell[axis].weight == 0.0) return low;
    return low + cell[axis].weight * (between(table, cell, axis + 1, axes, place + 1) - low);
}

// The same at both ends of the cell of the sliding speed.
inline TabulatedFriction<double> read(const FrictionTable& table, const double* logarithm) {
    Cell cell[TABLE_AXES];
    for (int axis = 0; axis < TABLE_AXES; ++axis)
        cell[axis] = cell_of(table, axis, logarithm[axis]);
    const Cell sliding = cell[SLIDING_AXIS];
    if (sliding.per_logarithm == 0.0) return {between(table, cell, 0, TABLE_AXES, 0), 0.0};
    cell[SLIDING_AXIS].weight = 0.0;
    double low = between(table, cell, 0, TABLE_AXES, 0);
    ++cell[SLIDING_AXIS].first;
    double rise = between(table, cell, 0, TABLE_AXES, 0) - low;
    return {low + sliding.weight * rise, rise * sliding.per_logarithm};
}

}  // namespace table

// From the logarithms of lambda ratio, pressure in Pa, and both speeds in m/s.
inline TabulatedFriction<double> tabulated_friction(const FrictionTable& table, double log_lambda,
                                                    double log_pressure, double log_rolling,
                                                    double log_sliding) {
    const double logarithm[TABLE_AXES] = {log_lambda, log_pressure, log_rolling, log_sliding};
    return table::read(table, logarithm);
}

inline TabulatedFriction<Lanes> tabulated_friction(const FrictionTable& table, Lanes log_lambda,
                                                   Lanes log_pressure, Lanes log_rolling,
                                                   Lanes log_sliding) {
    TabulatedFriction<Lanes> found{};
    for (int k = 0; k < WIDTH; ++k) {
        auto one = tabulated_friction(table, log_lambda[k], log_pressure[k], log_rolling[k],
                                      log_sliding[k]);
        found.coefficient[k] = one.coefficient;
        found.growth[k] = one.growth;
    }
    return found;
}

struct TableLaw {
    static constexpr const char* NAMES[] = {"table"};
    static constexpr bool INCLUDES_BOUNDARY = true;
    static constexpr const char* USES[] = {"friction_table"};
    static constexpr bool SINGLE_PRECISION = false;

    template <class Real>
    ALWAYS_INLINE static Friction<Real> friction(const Oil& oil, const Contact<Real>& contact) {
        Real log_lambda =
            oil.prescribed ? Real{} + oil.log_lambda : contact.log_thickness() - oil.log_roughness;
        Real log_pressure = 0.5 * (contact.log_load - contact.log_radius) - oil.log_area;  // of F/A
        auto [mu, growth] = tabulated_friction(oil.table, log_lambda, log_pressure,
                                               contact.log_speed, log(contact.speed));
        return {Real{}, mu * contact.load, growth * contact.load / contact.speed};
    }
};

}  // namespace gearbox
