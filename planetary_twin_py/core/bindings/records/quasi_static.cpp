#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "quasi_static/equilibrium_record.hpp"
#include "quasi_static/springs.hpp"

namespace gearbox {

void bind_quasi_static_records(nb::module_& m) {
    record<Equilibrium>(m, "Equilibrium")
        .FIELD(Equilibrium, state)
        .FIELD(Equilibrium, step)
        .FIELD(Equilibrium, evaluation)
        .FIELD(Equilibrium, before)
        .FIELD(Equilibrium, closing_side)
        .FIELD(Equilibrium, error)
        .FIELD(Equilibrium, stiffness)
        .FIELD(Equilibrium, clearance)
        .FIELD(Equilibrium, force)
        .FIELD(Equilibrium, torque)
        .FIELD(Equilibrium, balance)
        .FIELD(Equilibrium, external)
        .FIELD(Equilibrium, springs)
        .FIELD(Equilibrium, both_flanks);
    record<Springs>(m, "Springs")
        .FIELD(Springs, copies)
        .FIELD(Springs, error)
        .FIELD(Springs, compliance)
        .FIELD(Springs, friction)
        .FIELD(Springs, steps);
}

}  // namespace gearbox
