// Where a run begins, for `planetary_twin_py.dynamics.start`.

#include "train/initial_state.hpp"

#include "bindings/arrays.hpp"
#include "bindings/parts.hpp"
#include "bindings/unlocked.hpp"
#include "capacities.hpp"

namespace gearbox {

namespace {

nb::tuple py_initial_state(const Model& model, const ConstArray& speed, double force) {
    check_size("speed", speed.size(), AXES);
    InitialState found;
    {
        Unlocked release;
        found = initial_state(model, speed.data(), force);
    }
    return nb::make_tuple(found.state, found.unbalanced, found.body);
}

}  // namespace

void bind_initial_state(nb::module_& m) {
    m.def(
        "initial_state", &py_initial_state, nb::arg("model"), nb::arg("speed"), nb::arg("force"),
        nb::sig("def initial_state(model: Model, speed: Annotated[NDArray[numpy.float64], "
                "dict(order='C', device='cpu', writable=False)], force: float) -> "
                "tuple[State, float, int]"),
        "The state in which a run begins: speeds of the motors (AXES,) [rad/s], mean force of\n"
        "every mesh [N]. With it the largest force [N] on a body that nothing balances, and that\n"
        "body.");
}

}  // namespace gearbox
