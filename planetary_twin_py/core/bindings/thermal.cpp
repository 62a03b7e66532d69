// Temperatures of a gearbox, for `planetary_twin_py.run.warming`.

#include <nanobind/stl/tuple.h>

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "bindings/unlocked.hpp"
#include "model/still_air.hpp"
#include "run/window.hpp"

namespace gearbox {

using namespace nb::literals;

void bind_thermal(nb::module_& m) {
    CONSTANTS(m, NODES, HEATS);
    m.def(
        "free_convection",
        [](double wall, double air, double height) {
            auto [rayleigh, nusselt, coefficient] = free_convection(wall, air, height);
            return std::tuple(rayleigh, nusselt, coefficient);
        },
        "wall"_a, "air"_a, "height"_a,
        "Rayleigh and Nusselt number and coefficient [W/(m^2 K)] of free convection of a vertical "
        "plate; temperatures [K], height [m].");
    m.def("radiation", &radiation, "wall"_a, "air"_a, "emissivity"_a,
          "Coefficient of radiation [W/(m^2 K)]; temperatures [K].");
    m.def("to_ambient_air", &to_ambient_air, "network"_a,
          "Conductance from the housing to the ambient air [W/K].");
    m.def(
        "advance_network",
        [](Network& network, const ConstArray& heat, double duration) {
            check_size("heat", heat.size(), HEATS);
            advance_network(network, heat.data(), duration);
        },
        "network"_a, "heat"_a, "duration"_a,
        "Take heat of each source (HEATS,) [J] at constant power in `duration` [s].");
    m.def("has_moved", &has_moved, "network"_a,
          "Whether a temperature has moved by the dead band since the last `warm_oil`.");
    m.def("warm_oil", &warm_oil, "network"_a, "oil"_a,
          "Set the viscosities of `oil` to those at the temperatures of the network.");
    m.def(
        "warm_up",
        [](Model& model, Integrator& integrator, Network& network, const InstantTuple& now,
           double duration) {
            bool renewed = false;
            run_unlocked(
                [&] { renewed = warm_up(model, integrator, network, instant_of(now), duration); });
            return renewed;
        },
        "model"_a, "integrator"_a, "network"_a, "now"_a, "duration"_a,
        "Let the network take the heat of the last `duration` seconds before `now`.\n\n"
        "Returns whether the run goes on with oil of another viscosity.\n\n"
        "Raises:\n    ArithmeticError: no finite state can be reached.");
}

}  // namespace gearbox
