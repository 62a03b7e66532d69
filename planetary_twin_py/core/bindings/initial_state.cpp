// Where a run begins, for `planetary_twin_py.dynamics.start`.

#include "train/initial_state.hpp"

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/unlocked.hpp"
#include "rooms.hpp"

namespace gearbox {

namespace {

State py_initial_state(const Model& model, const ConstArray& speed, double force) {
    check_size("speed", speed.size(), AXES);
    Unlocked release;
    return initial_state(model, speed.data(), force);
}

}  // namespace

void bind_initial_state(nb::module_& m) {
    m.def("initial_state", &py_initial_state, nb::arg("model"), nb::arg("speed"), nb::arg("force"),
          "The state in which a run begins: speeds of the motors (AXES,) [rad/s], mean force of\n"
          "every mesh [N].");
}

}  // namespace gearbox
