#include "bindings/records.hpp"

NB_MODULE(_core, m) {
    m.doc() = "Compiled core of planetary_twin_py.";
    gearbox::bind_records(m);
}
