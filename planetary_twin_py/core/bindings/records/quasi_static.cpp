#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "quasi_static/equilibrium_record.hpp"
#include "quasi_static/springs.hpp"

namespace gearbox {

void bind_quasi_static_records(nb::module_& m) {
    RECORD(m, Equilibrium, state, step, evaluation, before, closing_side, error, stiffness,
           clearance, force, torque, balance, external, springs, both_flanks);
    RECORD(m, Springs, copies, error, compliance, friction, steps);
}

}  // namespace gearbox
