#include "bindings/parts.hpp"
#include "bindings/unlocked.hpp"
#include "vector/lanes.hpp"

#ifdef MOVING_AXES
#define NAME_IN_PYTHON "planetary_twin_py._core.axes"
#else
#define NAME_IN_PYTHON "planetary_twin_py._core"
#endif

namespace gearbox {
extern const char* const SOURCES;  // digest of the sources, of a file that the build writes
}

// One module for each processor level (CMake names it), and one for moving axes; all levels have
// the same name in Python, so objects pickled on one machine can be loaded on another.
NB_MODULE(CORE_MODULE, m) {
    m.attr("__name__") = NAME_IN_PYTHON;
    m.doc() = "Compiled core of planetary_twin_py.";
    m.attr("SOURCES") = gearbox::SOURCES;
    m.attr("FUSES") = gearbox::FUSES;
    nanobind::set_leak_warnings(false);  // caches hold records until the interpreter ends
    pthread_atfork(nullptr, nullptr, interpreter::forget_threads);
    nanobind::module_::import_("atexit").attr("register")(
        nanobind::cpp_function([] { interpreter::hold_threads(); }));
    gearbox::bind_core(m);
#ifndef MOVING_AXES
    gearbox::bind_lubrication(m);
    gearbox::bind_operating_point(m);
    gearbox::bind_exported(m);
#endif
}
