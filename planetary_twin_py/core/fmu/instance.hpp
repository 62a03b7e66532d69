#pragma once

// Interface of a gearbox in a co-simulation for the adapters of FMI 2.0 and 3.0. The gearbox is
// compiled for each processor level; the adapters are compiled once and load the best level.

#include <cstdint>
#include <string>

namespace fmu {

// Error message in one line; empty: no error.
using ErrorMessage = std::string;

// State of a run; its owner deletes it.
struct Snapshot {
    virtual ~Snapshot() = default;
};

class Instance {
public:
    virtual ~Instance() = default;

    // Values of variables, which are numbered by their value references.
    virtual ErrorMessage set(std::uint32_t variable, double value) = 0;
    virtual ErrorMessage get(std::uint32_t variable, double& value) = 0;

    // Set the local error tolerance of the integrator, before the start.
    virtual ErrorMessage set_tolerance(double tolerance) = 0;

    // Set the start time [s]; then `start` ends the initialisation.
    virtual void begin_at(double time) = 0;
    virtual ErrorMessage start() = 0;

    // Simulate from one communication point to another [s].
    virtual ErrorMessage step(double from, double to) = 0;

    // Restore the state after the instantiation.
    virtual void reset() = 0;

    virtual Snapshot* snapshot() const = 0;
    virtual void restore(const Snapshot& snapshot) = 0;
};

// Function `make_instance` of the library of a level: reads the records of a scene. If it fails, it
// returns null and sets the message.
using MakeInstance = Instance* (*)(const char* records, ErrorMessage& error);

}  // namespace fmu
