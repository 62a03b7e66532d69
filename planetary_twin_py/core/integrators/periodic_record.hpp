#pragma once

#include <cstdint>
#include <vector>

#include "integrators/propagation_records.hpp"
#include "integrators/sample_table.hpp"
#include "mesh/mesh_sums.hpp"
#include "train/state.hpp"

namespace gearbox {

struct alignas(64) Place {
    State state;
    double after;                       // start of the cycle [s]
    double turned;                      // by the motor since then [turns]
    alignas(64) double energy[LEDGER];  // growth of the ledger since then [J], [N m s]
};

struct alignas(64) CycleStep {
    Place begin;
    Place end;
    bool collocated;
    alignas(64) double power[LEDGER];  // at its end, see EVALUATION
    alignas(64) double friction_force[BODIES];
    ModalMotion motion;
    MeshSums sums;
    SampleTable samples;
};

struct alignas(64) Periodic {
    std::int64_t cycles;     // mesh cycles until all is as before, 0: never
    std::int64_t numerator;  // turns of the motor meanwhile, as a fraction
    std::int64_t denominator;
    double pause;         // [s] for which the train must not stray at least
    std::int64_t passed;  // mesh cycles since it was last looked whether the train repeats
    std::int64_t age;     // times that it was since something acted from outside
    std::int64_t reference_age;
    State reference;  // from which the train has not strayed since
    bool recording;
    bool replaying;
    std::int64_t steps;  // on the tape
    std::int64_t place;  // of the step on the tape that comes next
    std::int64_t known;  // contact states known when the last step was put on the tape
    State start;  // clock, turns and ledger where the present cycle starts; the fraction of the ...
    std::int64_t part;  // ... turn is that of the first cycle, and this many denominators
    Place whole;        // end of the cycle
    std::vector<CycleStep> cycle_steps;
    // Of all sample tables of the tape, one after another. Tables with memory of their own would
    // keep the largest that each place on the tape has ever had, and grow for hours with changes.
    std::vector<double> coefficients;
    MeshSums sums;  // of the whole cycle
};

}  // namespace gearbox
