#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "integrators/propagation_records.hpp"
#include "mesh/mesh_sums.hpp"
#include "model/passages_record.hpp"
#include "model/state.hpp"

namespace gearbox {

// Samples over one step of a repeated cycle: a polynomial for each column of a sample, in s from -1
// to 1 over a piece of the step, see `sample_cycle`.
struct SampleTable {
    static constexpr int MOST_PIECES = 8;

    enum Fits : std::int8_t { UNKNOWN, YES, NO };

    bool known = false;           // whether it has been computed
    int pieces = 0;               // equal parts of the step; 0: no polynomials
    Fits fits[MOST_PIECES] = {};  // whether the polynomials of a piece are accurate enough
    std::size_t begin = 0;        // of its (pieces, terms, columns) in `Periodic::coefficients`
};

struct alignas(64) Place {
    State state;
    double after;                       // since the start of the cycle [s]
    double turned;                      // turns of the motor since then
    alignas(64) double energy[LEDGER];  // increase of the ledger since then [J], [N m s]
};

struct alignas(64) CycleStep {
    Place begin;
    Place end;
    bool collocated;
    alignas(64) double power[LEDGER];  // at its end, see Evaluation
    alignas(64) double friction_force[BODIES];
    ModalMotion motion;
    MeshSums sums;
    SampleTable samples;
};

// After a small change of the oil, which neither makes the motion unstable nor needs time to
// settle, one period is measured, and the speed loop is trimmed for the change of its losses. If
// the motion was steady, the next period is recorded and compared. Otherwise the train goes on
// staying near its reference.
constexpr std::int64_t NOT_RETUNED = 0, WAITS = 1, MEASURES = 2, COMPARES = 3;

inline constexpr std::int64_t MOST_CYCLE_STEPS = 4096;  // largest number of steps in a cycle

struct Integrator;

struct alignas(64) Periodic {
    std::int64_t cycles;     // mesh cycles in a period, 0: not periodic
    std::int64_t numerator;  // turns of the motor in a period, as a fraction
    std::int64_t denominator;
    double pause;         // least time for which states must agree before a replay [s]
    std::int64_t passed;  // mesh cycles since the last check of periodicity
    std::int64_t age;     // number of checks since the last change of an input
    std::int64_t reference_age;
    State reference;                    // with which later states are compared
    std::vector<Integrator> neighbour;  // the run beside the train, if any, see `neighbour.hpp`
    std::int64_t joined;                // last periods in which it was near the train
    std::int64_t retuning;              // see above
    bool steady;                        // before the oil changed
    double loss;                        // of the last period with the oil before [J]
    double loss_at_start;               // ledger of losses at the last check [J]
    bool recording;
    bool replaying;
    std::int64_t steps;  // recorded
    std::int64_t place;  // of the next step to be replayed
    std::int64_t known;  // known contact states when the last step was recorded
    State start;         // clock, turns and ledger at the start of the present cycle, the
    std::int64_t part;   // fraction of the turn being that of the first cycle + part/denominator
    Place whole;         // end of the cycle
    std::vector<CycleStep> cycle_steps;
    // Coefficients of all sample tables, one after another. Separate vectors for each step would
    // each keep their largest capacity, and memory would grow for hours with changes.
    std::vector<double> coefficients;
    MeshSums sums;                     // of the whole cycle, without the passages
    std::vector<Passed> pairs_passed;  // in it
    std::int64_t advance;              // mesh cycles of the frame in it, signed
    std::int64_t ahead;                // by which the present cycle is later than the recorded one
    std::vector<Passages> passages;    // after each step, where damage is counted
};

}  // namespace gearbox
