#pragma once

// Errors of the core as Python's.

#include <nanobind/nanobind.h>

#include "bindings/interruptible.hpp"
#include "integrators/methods.hpp"

namespace gearbox {

constexpr const char* NO_FINITE_STATE = "no finite state can be reached, however short the step";

// Run without the interpreter's lock, until Ctrl-C; NoFiniteState becomes an ArithmeticError.
template <class Function>
void run_unlocked(Function&& function) {
    bool finite = true;
    {
        Interruptible release;
        try {
            function();
        } catch (const NoFiniteState&) {
            finite = false;
        }
    }
    if (finite) return;
    PyErr_SetString(PyExc_ArithmeticError, NO_FINITE_STATE);
    throw nanobind::python_error();
}

}  // namespace gearbox
