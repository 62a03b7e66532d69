#pragma once

// A gearbox in a co-simulation, as the adapters of FMI 2.0 and 3.0 see it. It is compiled for each
// level of x86-64; the adapters are compiled once, for every processor, and load the best.

#include <cstdint>
#include <string>

namespace fmu {

// What went wrong, in one line; empty: nothing.
using Complaint = std::string;

// All that changes in a run; its owner deletes it.
struct Snapshot {
    virtual ~Snapshot() = default;
};

class Instance {
public:
    virtual ~Instance() = default;

    // Values of variables, which are numbered by their value references.
    virtual Complaint set(std::uint32_t variable, double value) = 0;
    virtual Complaint get(std::uint32_t variable, double& value) = 0;

    // Take the local error tolerance of the integrator; before the start.
    virtual Complaint set_tolerance(double tolerance) = 0;

    // Begin at a time [s], and end the initialisation.
    virtual void begin_at(double time) = 0;
    virtual Complaint start() = 0;

    // Simulate from one communication point to another [s].
    virtual Complaint step(double from, double to) = 0;

    // Back to what it was when it was made.
    virtual void reset() = 0;

    virtual Snapshot* snapshot() const = 0;
    virtual void restore(const Snapshot& snapshot) = 0;
};

// Function `make_instance` of the library of a level: reads the records of a scene; null where it
// cannot, and then tells why.
using MakeInstance = Instance* (*)(const char* records, Complaint& complaint);

}  // namespace fmu
