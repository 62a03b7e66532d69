// Load sharing of the planets.

#include <nanobind/stl/pair.h>
#include <nanobind/stl/tuple.h>

#include "parts.hpp"
#include "quasi_static/planet_load.hpp"

namespace gearbox {

namespace nb = nanobind;
using namespace nb::literals;

namespace {

using Steps = std::tuple<double, double, double>;

template <double inverse(double, double, double, const double*)>
double with_steps(double value, double compliance, double friction, const Steps& steps) {
    double room[] = {std::get<0>(steps), std::get<1>(steps), std::get<2>(steps)};
    return inverse(value, compliance, friction, room);
}

}  // namespace

void bind_planet_load_parts(nb::module_& m) {
    m.def(
        "ring_force",
        [](double w, double compliance, double friction, const Steps& steps) {
            double room[] = {std::get<0>(steps), std::get<1>(steps), std::get<2>(steps)};
            SpringForce found = ring_force(w, compliance, friction, room);
            return std::make_pair(found.force, found.growth);
        },
        "w"_a, "compliance"_a, "friction"_a, "steps"_a,
        "Force [N] of a planet on the ring and its growth with the wind-up w [N/m].");
    m.def("windup_at", &with_steps<windup_at>, "force"_a, "compliance"_a, "friction"_a, "steps"_a,
          "A wind-up [m] at which a planet has a force on the ring.");
    m.def(
        "planet_force",
        [](const Springs& springs, std::int64_t p, double w) {
            SpringForce found = planet_force(springs, p, w);
            return std::make_pair(found.force, found.growth);
        },
        "springs"_a, "p"_a, "w"_a,
        "Force [N] of planet p on the ring at a wind-up [m], and its growth with it.");
}

}  // namespace gearbox
