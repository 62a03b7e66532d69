#pragma once

// Windows of many runs at once, in threads.
//
// Each run belongs to one thread and depends on nothing else: the results are those of one
// run after the other, to the last bit.

#include <vector>

#include "run/window.hpp"

namespace gearbox {

// Run every job; no two of them are of one march. The outcomes are in the order of the jobs.
std::vector<Outcome> run_windows(const std::vector<WindowJob>& jobs, int workers);

}  // namespace gearbox
