#include "bindings/parts.hpp"
#include "bindings/record.hpp"
#include "mesh/mesh_sums.hpp"
#include "mesh/meshes_now.hpp"

namespace gearbox {

void bind_mesh_records(nb::module_& m) {
    record<MeshesNow>(m, "MeshesNow")
        .FIELD(MeshesNow, advance)
        .FIELD(MeshesNow, cycle_rate)
        .FIELD(MeshesNow, speed_damping_time)
        .FIELD(MeshesNow, d)
        .FIELD(MeshesNow, rate)
        .FIELD(MeshesNow, error_rate)
        .FIELD(MeshesNow, normal_force)
        .FIELD(MeshesNow, damping_power)
        .FIELD(MeshesNow, stiffness_power)
        .FIELD(MeshesNow, stiffness)
        .FIELD(MeshesNow, stiffening)
        .FIELD(MeshesNow, moment)
        .FIELD(MeshesNow, share)
        .FIELD(MeshesNow, load);
    record<MeshSums>(m, "MeshSums")
        .FIELD(MeshSums, time)
        .FIELD(MeshSums, integral)
        .FIELD(MeshSums, dte_peak)
        .FIELD(MeshSums, force_peak);
}

}  // namespace gearbox
