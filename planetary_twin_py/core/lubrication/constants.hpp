#pragma once

#include <cstdint>

namespace gearbox {

struct alignas(64) Film {
    double log_coefficient;
    double speed;
    double material;
    double load;
};

struct alignas(64) Asperities {
    double area_factor;
    double pressure_factor;
    double shear_stress;
    double pressure_coefficient;
};

struct alignas(64) Traction {
    double shear_stress;
    double pressure_viscosity;
    double log_root;
    double least;
    double log_heating;
};

struct alignas(64) ShearThinning {
    double shear_stress;
    double pressure_viscosity;
    double log_shear_time;
    double limiting_stress;
    double film_heating;
    double flash_heating;
};

// Quantities of a table of friction: lambda ratio, mean pressure, mean surface speed, sliding
// speed.
constexpr int TABLE_AXES = 4, TABLE_KNOTS = 16, TABLE_VALUES = 1024;
constexpr int SLIDING_AXIS = TABLE_AXES - 1;

struct alignas(64) FrictionTable {
    std::int64_t size[TABLE_AXES];  // number of values of each quantity; 1: does not depend on it
    alignas(64) double knot[TABLE_AXES][TABLE_KNOTS];  // their logarithms, ascending
    alignas(64) double coefficient[TABLE_VALUES];      // [-], the last quantity fastest
};

}  // namespace gearbox
