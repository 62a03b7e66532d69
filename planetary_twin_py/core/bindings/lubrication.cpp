// The laws of friction, film and losses for Python: studies, tests and the builders of records.

#include <nanobind/stl/tuple.h>

#include "bindings/parts.hpp"
#include "bindings/vectors.hpp"
#include "lubrication/bearing_friction.hpp"
#include "lubrication/churning.hpp"
#include "lubrication/tooth_friction.hpp"
#include "vector/combine.hpp"
#include "vector/math.hpp"

namespace gearbox {

using namespace nb::literals;

namespace {

void bind_math(nb::module_& m) {
    m.def("exp", [](double x) { return exp(x); }, "x"_a);
    m.def("precise_exp", [](double x) { return precise_exp(x); }, "x"_a);
    m.def("log", [](double x) { return log(x); }, "x"_a);
    m.def(
        "logs",
        [](double x, double y, double z) {
            auto [first, second, third] = logs(x, y, z);
            return std::tuple(first, second, third);
        },
        "x"_a, "y"_a, "z"_a);
    m.def("power", &power, "x"_a, "y"_a, "x**y for x >= 0.");
    m.def(
        "sin_cos",
        [](double x) {
            auto [sine, cosine] = sin_cos(x);
            return std::tuple(sine, cosine);
        },
        "x"_a);
    m.def(
        "combine",
        [](const Square& rows, const Vector& weights, std::int64_t count, const Values& out) {
            combine(matrix(rows), bodies(weights), count, bodies(out));
        },
        "rows"_a, "weights"_a, "count"_a, "out"_a);
    m.def(
        "combine_both",
        [](const Square& rows, const Vector& first, const Vector& second, std::int64_t count,
           const Values& out_first, const Values& out_second) {
            combine_both(matrix(rows), bodies(first), bodies(second), count, bodies(out_first),
                         bodies(out_second));
        },
        "rows"_a, "first"_a, "second"_a, "count"_a, "out_first"_a, "out_second"_a);
    m.def(
        "factorise", [](const Square& a, std::int64_t n) { factorise(matrix(a), n); }, "a"_a,
        "n"_a);
    m.def(
        "solve",
        [](const Square& a, std::int64_t n, const Values& b) { solve(matrix(a), n, bodies(b)); },
        "a"_a, "n"_a, "b"_a);
}

void bind_laws(nb::module_& m) {
    m.attr("THINNEST_FILM") = THINNEST_FILM;
    m.attr("SLOWEST_ROLLING") = SLOWEST_ROLLING;
    m.attr("CREEPING") = CREEPING;
    m.attr("ELASTIC") = ELASTIC;
    nb::dict laws, uses;
    nb::list without_boundary;
    FrictionLaws::each([&]<class Law>(int position) {
        nb::list fields;
        for (const char* field : Law::USES) fields.append(field);
        for (const char* name : Law::NAMES) {
            laws[name] = position;
            uses[name] = nb::tuple(fields);
            if (!Law::INCLUDES_BOUNDARY) without_boundary.append(name);
        }
    });
    m.attr("TRACTION_LAWS") = laws;
    m.attr("FIELDS_OF_TRACTION") = uses;
    m.attr("WITHOUT_BOUNDARY") = nb::tuple(without_boundary);
    m.def("log_film_thickness", &log_film_thickness<double>, "law"_a, "log_radius"_a,
          "log_speed_group"_a, "log_material_group"_a, "log_load_group"_a);
    m.def("half_width", &half_width<double>, "load"_a, "radius"_a, "face_width"_a,
          "contact_modulus"_a);
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
          "log_film"_a, "log_heat"_a);
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

using Pair = std::tuple<double, double, double, double, double, double>;

void bind_pairs(nb::module_& m) {
    m.def("lambda_ratio_of", &lambda_ratio_of, "oil"_a, "log_film"_a,
          "Specific film thickness [-]: as given, or film over roughness.");
    m.def(
        "tooth_contact",
        [](const Oil& oil, const Pair& pair, double slowest_rolling) {
            auto [rho1, rho2, external, speed1, speed2, load] = pair;
            PairFriction<double> f{};
            with_laws(oil, [&]<class Laws>() {
                PairMotion<double> found{rho1, rho2, external, speed1, speed2, load};
                f = tooth_contact<Laws>(oil, area_factor(oil), found, slowest_rolling);
            });
            return std::tuple(f.friction, f.boundary, f.viscous, f.log_film, f.sliding, f.slope,
                              f.rolling, f.rolling_power);
        },
        "oil"_a, "pair"_a, "slowest_rolling"_a = SLOWEST_ROLLING,
        "Friction of a tooth pair: signed, boundary, viscous [N], log film, sliding [m/s], slope "
        "[N s/m], rolling resistance [N] and its power [W]; from radii of curvature [m], +1 "
        "(external) "
        "or -1, speeds relative to the carrier [rad/s] and load [N].");
    m.def(
        "turn_pairs",
        [](const Train& train, const StepConstants& step, const Vector& v, ToothPairs& pairs) {
            turn_pairs(train, step, bodies(v), pairs);
        },
        "train"_a, "step"_a, "v"_a, "pairs"_a);
    m.def("evaluate", &evaluate, "model"_a, "pairs"_a, release(),
          "Film and friction of `pairs.count` tooth pairs.");
    m.def("collect", &collect, "train"_a, "pairs"_a, "out"_a);
    m.def(
        "friction_damping",
        [](const Train& train, const ToothPairs& pairs, const Vector& force, double h,
           const Square& out) {
            double row[ENTRIES];
            friction_damping(train, pairs, bodies(force), h, row, matrix(out));
        },
        "train"_a, "pairs"_a, "force"_a, "h"_a, "matrix"_a);
    m.def("creeps", &creeps, "train"_a, "cycle_rate"_a);
    m.def(
        "pass_bristles",
        [](const Train& train, const Values& share, std::int64_t i, std::int64_t segment,
           std::int64_t direction) {
            pass_bristles(train, entries(share, PAIR_CAPACITY), i, segment, direction);
        },
        "train"_a, "share"_a, "i"_a, "segment"_a, "direction"_a);
}

}  // namespace

void bind_lubrication(nb::module_& m) {
    bind_math(m);
    bind_laws(m);
    bind_pairs(m);
}

}  // namespace gearbox
