#pragma once

// A window of a run: its waveform, and the state of the train at its end.

#include <cstdint>
#include <iterator>

#include "integrators/integrator_record.hpp"
#include "mesh/mesh_sums.hpp"
#include "model/model.hpp"
#include "run/clock.hpp"
#include "run/limits.hpp"
#include "run/report.hpp"

namespace gearbox {

// All samples of moving axes. Displacements and forces of sun, ring, carrier and planets are those
// of MovingAxes; orbits are those of the first three in the housing.
struct AxesWaveform {
    double* displacement;   // (rows, bearings, 2) [m]
    double* bearing_force;  // (rows, bearings, 2), on the bearing [N]
    double* orbit;          // (rows, MEMBERS, 2) [m]
    double* flank_force;    // (rows, FLANKS, meshes), drive flanks first, magnitude [N]
    double* tilting;        // (rows, bearings, SAMPLE_TILTING), see Samples; only if axes tilt
};

// A quantity of the waveform of a mesh: the sum of rows of `observe`.
struct WaveQuantity {
    const char* name;  // as in messages and results
    int first, last;   // rows
    bool of_flank;     // whether the flanks of a mesh add up; they have the DTE in common
};

inline constexpr WaveQuantity WAVEFORM[] = {
    {"dte", DTE, DTE, false},                      // [m]
    {"mesh_force", MESH_FORCE, MESH_FORCE, true},  // [N]
    {"friction", BOUNDARY, VISCOUS, true},         // magnitude [N]
};
constexpr int WAVE_QUANTITIES = std::size(WAVEFORM);

// Value of a quantity, given `value(row)` of the rows of `observe`.
template <class Value>
inline double wave_of(const WaveQuantity& quantity, Value&& value) {
    double sum = value(quantity.first);
    for (int row = quantity.first + 1; row <= quantity.last; ++row) sum += value(row);
    return sum;
}

// All samples of all reported meshes, in arrays of the caller.
struct Waveform {
    std::int64_t rows;
    std::int64_t first;             // number of the first sample
    double rate;                    // [Hz]
    double* time;                   // (rows,) [s]
    double* mesh[WAVE_QUANTITIES];  // (rows, meshes) each
    AxesWaveform axes;              // not requested if the axes are fixed
};

// State of the train at the end of a window, and the sums up to it.
//
// Within the step that contains the end, the powers of the ledger are taken as constant.
struct alignas(64) WindowEnd {
    double ledger[LEDGER];    // since the last reading
    double power[LEDGER];     // of the ledger, at the end of the last step
    double kinetic, elastic;  // energies [J]
    double turns[AXES];       // whole turns of the motors
    double angle[BODIES];     // in addition to these [rad]
    MeshSums sums;            // of the window
    Peaks peaks;              // of its samples
};

// The task: a window, or the first part of one.
struct WindowJob {
    const Model& model;
    Integrator& integrator;
    Instant until;
    Sampling samples;
    const Limits& limits;
    const Report& report;
    Waveform out;
    WindowEnd& end;
    bool closes;  // whether the window ends there
};

enum class Outcome { WITHIN_LIMITS, EXCEEDED, NOT_FINITE, REFUSED };

// Integrate to `until`; fill the waveform, and turns, angles, peaks and power of `end`.
//
// If the window ends within the limits, ledger and sums are moved to `end`.
Outcome run_window(const WindowJob& job);

// Copy the integrals of the ledger from the last call up to `until`, the end of the last window,
// and set them to zero: rounding errors of the sums of a long run would exceed the increments of a
// window.
void pop_energy_ledger(Integrator& integrator, const Instant& until, double* ledger);

// Copy integrals and extremes of the meshes up to `until`, the end of the last window, and restart
// them.
void pop_mesh_sums(const Model& model, Integrator& integrator, const Instant& until,
                   MeshSums& sums);

// Start a window at `now`, the end of the last one: fill ledger, power and stored energy of `end`.
void begin_window(const Model& model, Integrator& integrator, const Instant& now, WindowEnd& end);

}  // namespace gearbox
