#pragma once

// Windows of many runs at once, in threads.
//
// Each run is computed by one thread independently of the others: the results are bitwise those of
// sequential runs.

#include <vector>

#include "run/window.hpp"

namespace gearbox {

// Run all jobs; no two of them share an integrator. The outcomes are in the order of the jobs.
std::vector<Outcome> run_windows(const std::vector<WindowJob>& jobs, int workers);

}  // namespace gearbox
