// The laws of friction and film for Python: studies and the builders of records.

#include <nanobind/stl/tuple.h>

#include "bindings/parts.hpp"
#include "lubrication/tooth_friction.hpp"

namespace gearbox {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

void bind_laws(nb::module_& m) {
    m.attr("CREEPING") = CREEPING;
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
    m.def("half_width", &half_width<double>, "load"_a, "radius"_a, "face_width"_a,
          "contact_modulus"_a);
}

using Pair = std::tuple<double, double, double, double, double, double>;

void bind_pairs(nb::module_& m) {
    m.def(
        "tooth_contact",
        [](const Oil& oil, const Pair& pair, double slowest_rolling) {
            auto [rho1, rho2, external, speed1, speed2, load] = pair;
            PairFriction<double> f{};
            const PairMotion<double> motion{rho1, rho2, external, speed1, speed2, load};
            with_laws(oil, [&]<class Laws>() {
                find_pair_friction<Laws, double, 1>(
                    oil, 1, [&](int) { return flanks_of(motion, oil, slowest_rolling); },
                    [&](int, const PairFriction<double>& found) { f = found; });
            });
            return std::tuple(f.friction, f.boundary, f.viscous, f.log_film, f.sliding, f.slope,
                              f.rolling, f.rolling_power);
        },
        "oil"_a, "pair"_a, "slowest_rolling"_a = SLOWEST_ROLLING,
        "Friction of a tooth pair: signed, boundary, viscous [N], log film, sliding [m/s], slope "
        "[N s/m], rolling resistance [N] and its power [W]; from radii of curvature [m], +1 "
        "(external) or -1, speeds relative to the carrier [rad/s] and load [N].");
}

}  // namespace

void bind_lubrication(nb::module_& m) {
    bind_laws(m);
    bind_pairs(m);
}

}  // namespace gearbox
