// Initial state of a run, for `planetary_twin_py.model.start`.

#include "model/initial_state.hpp"

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
    m.def("initial_state", &py_initial_state, nb::arg("model"), nb::arg("speed"), nb::arg("force"),
          nb::sig("def initial_state(model: Model, speed: Annotated[NDArray[numpy.float64], "
                  "dict(order='C', device='cpu', writable=False)], force: float) -> "
                  "tuple[State, float, int]"),
          "State at the start of a run, the largest unbalanced force on a body [N], and that "
          "body.\n\n"
          "`speed`: of the motors (AXES,) [rad/s]. `force`: mean force of every mesh [N].");
}

}  // namespace gearbox
