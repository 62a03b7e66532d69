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

}  // namespace gearbox
