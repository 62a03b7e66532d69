#pragma once

// A scene as a record in the file of an FMU. `planetary_twin_py.fmu` writes the file: the digest of
// the core, then this record byte for byte.

#include <cstdint>

#include "integrators/control.hpp"
#include "model/model.hpp"
#include "model/network.hpp"
#include "run/limits.hpp"
#include "run/operating_point.hpp"
#include "run/ports.hpp"
#include "run/report.hpp"

namespace gearbox {

constexpr int VARIABLES = 112;   // largest number; with 7 planets there are 105
constexpr int PARTS = 36;        // that collect damage; with 7 planets there are 35
constexpr int NAME = 64;         // characters of a name, with the final zero
constexpr int DIGEST = 64;       // characters before the record, padded with zeros
constexpr int NODE_CHOICES = 2;  // numbers of collocation points

// Kinds of variables.
constexpr std::int64_t TIME = 0, ANGLE = 1, SPEED = 2, TORQUE = 3, MESH = 4, POWER_LOST = 5,
                       POINT = 6, TEMPERATURE = 7, DAMAGE = 8;

// When a variable may be set.
constexpr std::int64_t NOT_GIVEN = 0, AT_ANY_TIME = 1, BEFORE_THE_END = 2;

// The index of a variable is its value reference.
struct Variable {
    std::int64_t kind;
    std::int64_t index;       // of the port, the node or the part, or in the operating point; of a
                              // mesh: its number and that of the quantity of `WAVEFORM` times the
                              // number of meshes
    std::int64_t given;       // NOT_GIVEN, AT_ANY_TIME or BEFORE_THE_END of the initialisation
    double lowest;            // lower limit of values that may be set
    double highest;           // upper limit of values that may be set
    std::uint8_t name[NAME];  // in the model description
};

// Number of mesh cycles in a period, and turns of the motor in a period.
struct Repetition {
    std::int64_t cycles;
    std::int64_t numerator;
    std::int64_t denominator;
};

// Temperatures, where they are states.
struct alignas(64) Warming {
    Network network;         // at the start
    std::int64_t period;     // between instants at which heat is taken [ticks]; 0: no states
    bool starts_ambient;     // whether all parts start at the ambient temperature
    double lowest, highest;  // of the range of the oil's laws [K]
};

struct alignas(64) Exported {
    Model model;      // with the oil of the scene
    Control control;  // before the first step
    double pause;     // see Periodic [s]
    Limits limits;
    PortRanges ranges;
    Report report;
    PointLaws laws;
    OperatingPoint point;
    Warming warming;
    // Damage of each part over that of the meshes.
    alignas(64) double of_part[PARTS][DAMAGES][MESHES];
    Repetition repetition[2];  // without and with torque ripple
    bool linear;               // interpolation of given values
    double tolerance;
    double tolerances[2];                  // allowed
    double least_tolerance[NODE_CHOICES];  // lowest tolerance for each number of points:
    std::int64_t points[NODE_CHOICES];
    std::int64_t variables;
    Variable variable[VARIABLES];
};

}  // namespace gearbox
