#pragma once

// A long call of the core without the interpreter's lock, which Ctrl-C ends, and its error in
// Python.

#include <nanobind/nanobind.h>

#include <chrono>
#include <optional>
#include <utility>

#include "bindings/unlocked.hpp"
#include "integrators/interruption.hpp"
#include "integrators/methods.hpp"

namespace gearbox {

class Interruptible final : interruption::Caller {
public:
    Interruptible() : outer_(interruption::caller) {
        unlocked_.emplace();
        interruption::caller = this;
    }
    ~Interruptible() override { interruption::caller = outer_; }
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;

    // Let the interpreter handle signals, rarely: to wait for its lock may take milliseconds.
    void look() override {
        const auto now = std::chrono::steady_clock::now();
        if (now < next_) return;
        const bool begins = next_ == std::chrono::steady_clock::time_point{};
        next_ = now + PAUSE;
        if (begins) return;
        unlocked_.reset();
        std::optional<nanobind::python_error> error;
        if (PyErr_CheckSignals() != 0) error.emplace();
        unlocked_.emplace();
        if (error) throw std::move(*error);
    }

private:
    static constexpr std::chrono::milliseconds PAUSE{200};

    interruption::Caller* outer_;
    std::chrono::steady_clock::time_point next_{};
    std::optional<Unlocked> unlocked_;
};

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
