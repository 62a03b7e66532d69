// Initial state of a run, for `planetary_twin_py.model.start`.

#include "model/initial_state.hpp"

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "bindings/unlocked.hpp"

namespace gearbox {

using namespace nb::literals;

void bind_initial_state(nb::module_& m) {
    RECORD(m, InitialState, state, unbalanced, body);
    m.def(
        "initial_state",
        [](const Model& model, const ConstArray& speed, double force) {
            check_size("speed", speed.size(), AXES);
            Unlocked unlocked;
            return initial_state(model, speed.data(), force);
        },
        "model"_a, "speed"_a, "force"_a,
        "State at the start of a run, see `InitialState`.\n\n"
        "`speed`: of the motors (AXES,) [rad/s]. `force`: mean force of every mesh [N].");
}

}  // namespace gearbox
