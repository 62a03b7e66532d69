#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "mesh/mesh_sums.hpp"
#include "mesh/meshes_now.hpp"

namespace gearbox {

void bind_mesh_records(nb::module_& m) {
    RECORD(m, MeshesNow, advance, cycle_rate, speed_damping_time, d, rate, error_rate, normal_force,
           damping_power, stiffness_power, stiffness, stiffening, moment, share, load);
    RECORD(m, MeshSums, time, integral, dte_peak, force_peak);
}

}  // namespace gearbox
