#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>

#include "run/window.hpp"

namespace gearbox {

std::vector<Outcome> run_windows(const std::vector<WindowJob>& jobs, int workers) {
    std::vector<Outcome> outcomes(jobs.size());
    std::vector<std::exception_ptr> defects(jobs.size());
    std::atomic<std::size_t> next = 0;  // next job for an idle thread
    auto work = [&] {
        for (std::size_t n = next++; n < jobs.size(); n = next++) {
            try {
                outcomes[n] = run_window(jobs[n]);
            } catch (...) {
                defects[n] = std::current_exception();
                next = jobs.size();
            }
        }
    };
    std::vector<std::jthread> helpers;
    std::size_t threads = std::min(static_cast<std::size_t>(workers), jobs.size());
    while (helpers.size() + 1 < threads) helpers.emplace_back(work);
    work();
    helpers.clear();  // waits for them
    for (const std::exception_ptr& defect : defects)
        if (defect) std::rethrow_exception(defect);
    return outcomes;
}

}  // namespace gearbox
