#pragma once

// Common part of FMI 2.0 and 3.0: an instance with its phase, and a callback for error messages.

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "each.hpp"
#include "fmu/instance.hpp"

#define EXPORTED extern "C" __attribute__((visibility("default")))

// A function that calls one of its component, which `of` gives.
#define FORWARDED(name, method)         \
    EXPORTED int name(void* instance) { \
        return of(instance).method();   \
    }

// Functions that copy, restore and free the state of one.
#define STATE_FUNCTIONS(get, set, free)              \
    EXPORTED int get(void* instance, void** state) { \
        return of(instance).get_state(state);        \
    }                                                \
    EXPORTED int set(void* instance, void* state) {  \
        return of(instance).set_state(state);        \
    }                                                \
    EXPORTED int free(void*, void** state) {         \
        return Component::free_state(state);         \
    }

// Functions that an FMU does not support, as its model description states. They read no argument
// but the instance, so one signature is sufficient.
#define REFUSE(of, ...) EACH(REFUSED, of, __VA_ARGS__)
#define REFUSED(of, name)                                      \
    EXPORTED int name(void* instance) {                        \
        return of(instance).refuse(#name ": is not provided"); \
    }

namespace fmu {

enum Status { OK, WARNING, DISCARD, ERROR, FATAL };

enum class Phase { MADE, INITIALIZING, STEPPING, STOPPED, FAILED };

class Component {
public:
    using Report = std::function<void(Status, const char*)>;

    Component(std::unique_ptr<Instance> instance, Report report)
        : instance_(std::move(instance)), report_(std::move(report)) {}

    Status get(const std::uint32_t* references, std::size_t count, double* values) {
        if (phase_ == Phase::MADE)
            return refuse("outputs: are available after the initialisation starts");
        for (std::size_t n = 0; n < count; ++n)
            if (Status status = answer(instance_->get(references[n], values[n]))) return status;
        return OK;
    }

    Status set(const std::uint32_t* references, std::size_t count, const double* values) {
        if (phase_ > Phase::STEPPING)
            return refuse("values: cannot be set after the end: " + ended());
        for (std::size_t n = 0; n < count; ++n)
            if (Status status = answer(instance_->set(references[n], values[n]))) return status;
        return OK;
    }

    Status set_experiment(bool with_tolerance, double tolerance, double start_time) {
        if (phase_ != Phase::MADE) return refuse("initialisation: must follow the instantiation");
        instance_->begin_at(start_time);
        return with_tolerance ? answer(instance_->set_tolerance(tolerance)) : OK;
    }

    Status enter_initialization() {
        if (phase_ != Phase::MADE) return refuse("initialisation: must follow the instantiation");
        phase_ = Phase::INITIALIZING;
        return OK;
    }

    Status exit_initialization() {
        if (phase_ != Phase::INITIALIZING)
            return refuse("initialisation: must be entered before it is left");
        phase_ = Phase::STEPPING;
        return answer(instance_->start());
    }

    Status step(double from, double size) {
        if (phase_ > Phase::STEPPING)
            return refuse("step: must follow the initialisation: " + ended());
        if (phase_ != Phase::STEPPING) return refuse("step: must follow the initialisation");
        const Status status = answer(instance_->step(from, from + size));
        if (status == ERROR) phase_ = Phase::FAILED;
        return status;
    }

    Status terminate() {
        if (phase_ > Phase::STEPPING) return refuse("termination: " + ended());
        if (phase_ != Phase::STEPPING) return refuse("termination: must follow the initialisation");
        phase_ = Phase::STOPPED;
        return OK;
    }

    Status reset() {
        instance_->reset();
        phase_ = Phase::MADE;
        return OK;
    }

    // Copy the state of the run; a copy that `state` already has is replaced.
    Status get_state(void** state) {
        free_state(state);
        *state = new State{phase_, std::unique_ptr<Snapshot>(instance_->snapshot())};
        return OK;
    }

    Status set_state(const void* state) {
        if (!state) return refuse("FMU state: is missing");
        const auto* saved = static_cast<const State*>(state);
        instance_->restore(*saved->snapshot);
        phase_ = saved->phase;
        return OK;
    }

    static Status free_state(void** state) {
        if (state) {
            delete static_cast<State*>(*state);
            *state = nullptr;
        }
        return OK;
    }

    Status refuse(const std::string& reason) {
        report_(ERROR, reason.c_str());
        return ERROR;
    }

private:
    struct State {
        Phase phase;
        std::unique_ptr<Snapshot> snapshot;
    };

    std::unique_ptr<Instance> instance_;
    Report report_;
    Phase phase_ = Phase::MADE;

    // What must follow the end of a run: the standard allows no other call after an error.
    std::string ended() const {
        const std::string how = phase_ == Phase::FAILED ? "the run has ended with an error"
                                                        : "the run has been terminated";
        return how + "; reset the instance, or restore an earlier state";
    }

    Status answer(const ErrorMessage& error) { return error.empty() ? OK : refuse(error); }
};

}  // namespace fmu
