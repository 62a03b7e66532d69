#include "parts.hpp"

// One module for each processor level, named by CMake. Its records are those of the core's module.
NB_MODULE(CORE_MODULE, m) {
    m.attr("__name__") = "planetary_twin_core_parts";
    gearbox::bind_vector_parts(m);
    gearbox::bind_lubrication_parts(m);
    gearbox::bind_mesh_parts(m);
    gearbox::bind_planet_load_parts(m);
    gearbox::bind_step_parts(m);
    gearbox::bind_solver_parts(m);
}
