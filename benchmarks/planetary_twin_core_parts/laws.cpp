// The laws of friction, film and losses, each by itself.

#include <nanobind/stl/tuple.h>

#include "lubrication/bearing_friction.hpp"
#include "lubrication/churning.hpp"
#include "lubrication/tooth_friction.hpp"
#include "matrices.hpp"
#include "parts.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

void bind_laws(nb::module_& m) {
    m.attr("THINNEST_FILM") = THINNEST_FILM;
    m.attr("SLOWEST_ROLLING") = SLOWEST_ROLLING;
    m.attr("ELASTIC") = ELASTIC;
    m.def("log_film_thickness", &log_film_thickness<double>, "law"_a, "log_radius"_a,
          "log_speed_group"_a, "log_material_group"_a, "log_load_group"_a);
    m.def("contact_area_function", &contact_area_function<double>, "lambda_ratio"_a);
    m.def("contact_load_function", &contact_load_function<double>, "lambda_ratio"_a);
    m.def("printed_area_function", &printed_area_function<double>, "x"_a);
    m.def("printed_load_function", &printed_load_function<double>, "x"_a);
    m.def("boundary_shear", &boundary_shear<double>, "asperities"_a, "printed"_a, "lambda_ratio"_a);
    m.def("film_share", &film_share<double>, "log_lambda"_a, "log_thickness"_a = 0.0);
    m.def("rolling_resistance", &rolling_resistance<double>, "size"_a, "log_speed_group"_a,
          "log_material_group"_a, "log_load_group"_a);
    m.def("schlenk_coefficient", &schlenk_coefficient<double>, "log_factor"_a, "log_load"_a,
          "log_speed"_a, "log_radius"_a);
    m.def("viscous_friction", &viscous_friction<double>, "traction"_a, "load"_a, "area"_a,
          "log_film"_a, "log_heat"_a, "log_viscosity"_a = 0.0);
    m.def("sliding_sense", &sliding_sense<double>, "ratio"_a);
    m.def(
        "film_shear",
        [](const ShearThinning& film, double load, double area, double log_film, double log_heat,
           double speed) {
            auto [friction, growth] = film_shear(film, load, area, log_film, log_heat, speed);
            return std::tuple(friction, growth);
        },
        "film"_a, "load"_a, "area"_a, "log_film"_a, "log_heat"_a, "speed"_a);
    m.def(
        "bristle_rate",
        [](double share, double sliding, double steady, double slope, double displacement) {
            auto [rate, decay, gain, slip] =
                bristle_rate(share, sliding, steady, slope, displacement);
            return std::tuple(rate, decay, gain, slip);
        },
        "share"_a, "sliding"_a, "steady"_a, "slope"_a, "displacement"_a);
    m.def("bearing_torque", &bearing_torque, "no_load_factor"_a, "load_factor"_a,
          "kinematic_viscosity"_a, "speed"_a, "load"_a);
    m.def("disc_torque", &disc_torque, "radius"_a, "gap_ratio"_a, "density"_a,
          "kinematic_viscosity"_a, "speed"_a);
}

void bind_pairs(nb::module_& m) {
    m.def(
        "lambda_ratio_of",
        [](const Oil& oil, double log_film) {
            return oil.prescribed ? oil.lambda_ratio : exp(log_film - oil.log_roughness);
        },
        "oil"_a, "log_film"_a, "Specific film thickness [-]: as given, or film over roughness.");
    m.def(
        "turn_pairs",
        [](const Train& train, const StepConstants& step, const Vector& v, ToothPairs& pairs) {
            turn_pairs(train, step, bodies(v), pairs);
        },
        "train"_a, "step"_a, "v"_a, "pairs"_a);
    m.def("evaluate", &evaluate, "model"_a, "pairs"_a, release(),
          "Film and friction of `pairs.count` tooth pairs.");
    m.def(
        "friction_damping",
        [](const Train& train, const ToothPairs& pairs, const Vector& force, double h,
           const Square& out) {
            double row[ENTRIES];
            friction_damping(train, pairs, bodies(force), h, row, matrix(out));
        },
        "train"_a, "pairs"_a, "force"_a, "h"_a, "matrix"_a);
    m.def(
        "pass_bristles",
        [](const Train& train, const Values& share, std::int64_t i, std::int64_t segment,
           std::int64_t direction) {
            pass_bristles(train, entries(share, PAIR_CAPACITY), i, segment, direction);
        },
        "train"_a, "share"_a, "i"_a, "segment"_a, "direction"_a);
}

}  // namespace

void bind_lubrication_parts(nb::module_& m) {
    bind_laws(m);
    bind_pairs(m);
}

}  // namespace gearbox
