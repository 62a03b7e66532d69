#pragma once

// Samples of the meshes, bodies and axes over a part of a window: those that the caller asks for.

#include <cstdint>
#include <iterator>
#include <memory>
#include <vector>

#include "capacities.hpp"
#include "model/train.hpp"
#include "run/report.hpp"
#include "run/samples.hpp"

namespace gearbox {

// How the value of a mesh follows from those of its drive and coast flanks, where each has an
// entry.
enum class OfFlanks {
    CARRYING,  // that of the flank that carries: both have the DTE in common
    SUM,
    EITHER,  // that of the flank that carries, or of the other one if this is NaN
};

// A quantity of the waveform of a mesh: the sum of rows of `observe`.
struct WaveQuantity {
    const char* name;  // as in messages and results
    int first, last;   // rows
    OfFlanks flanks;
};

// The first `PUBLISHED` of them are those of messages and of the windows of a twin.
inline constexpr WaveQuantity WAVEFORM[] = {
    {"dte", DTE, DTE, OfFlanks::CARRYING},                     // [m]
    {"mesh_force", MESH_FORCE, MESH_FORCE, OfFlanks::SUM},     // [N]
    {"friction", BOUNDARY, VISCOUS, OfFlanks::SUM},            // magnitude [N]
    {"film_thickness", FILM, FILM, OfFlanks::EITHER},          // [m]
    {"lambda_ratio", LAMBDA, LAMBDA, OfFlanks::EITHER},        // [-]
    {"boundary_friction", BOUNDARY, BOUNDARY, OfFlanks::SUM},  // magnitude [N]
    {"viscous_friction", VISCOUS, VISCOUS, OfFlanks::SUM},     // magnitude [N]
    {"power_loss", POWER_LOSS, POWER_LOSS, OfFlanks::SUM},     // [W]
    {"mesh_power", MESH_POWER, MESH_POWER, OfFlanks::SUM},     // in the frame of the carrier [W]
};
constexpr int WAVE_QUANTITIES = std::size(WAVEFORM), PUBLISHED = 3;

// Value of a quantity, given `value(row)` of the rows of `observe`.
template <class Value>
inline double wave_of(const WaveQuantity& quantity, Value&& value) {
    double sum = value(quantity.first);
    for (int row = quantity.first + 1; row <= quantity.last; ++row) sum += value(row);
    return sum;
}

// Samples of the reported bodies, and the losses of drag.
struct BodiesWaveform {
    double* angle;  // (rows, bodies) absolute [rad]
    double* speed;  // (rows, bodies) absolute [rad/s]
    double* drag;   // (rows, SAMPLE_DRAGS) [W]
};

// Samples of moving axes. Displacements and forces of sun, ring, carrier and planets are those of
// MovingAxes; orbits are those of the first three in the housing.
struct AxesWaveform {
    double* displacement;   // (rows, bearings, 2) [m]
    double* bearing_force;  // (rows, bearings, 2), on the bearing [N]
    double* orbit;          // (rows, MEMBERS, 2) [m]
    double* flank_force;    // (rows, FLANKS, meshes), drive flanks first, magnitude [N]
    double* tilting;        // (rows, bearings, SAMPLE_TILTING), see Samples; only if axes tilt
};

// Samples in arrays of the caller; a null pointer: not asked for.
struct Waveform {
    std::int64_t rows;
    Sampling begin;                 // the first sample
    std::int64_t first;             // its number
    double rate;                    // [Hz]
    double* time;                   // (rows,) [s]
    double* mesh[WAVE_QUANTITIES];  // (rows, reported meshes) each
    BodiesWaveform bodies;          // all of them, or none
    AxesWaveform axes;              // all of them, or none
    double* torque;                 // (rows, machines), on the members, with `bodies` [N m]
};

// Work space for the samples of a train, in the order of its bodies and meshes.
class SampleRoom {
public:
    SampleRoom(const Train& train, const Waveform& out, Peaks* peaks);

    // Where samples are to be written.
    const Samples& samples() const { return samples_; }

    // Write the samples as they are reported.
    void put(const Report& report, const Train& train, const Waveform& out) const;

private:
    std::unique_ptr<double[]> mesh_;
    std::vector<double> turns_, angle_, speed_, moved_, tilting_;
    Samples samples_;
};

}  // namespace gearbox
