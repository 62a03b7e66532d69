#include "quasi_static/planet_load.hpp"

#include <limits>

namespace gearbox {

namespace {

constexpr int MOST_TRIALS = 200;
constexpr double CLOSED = 1e-14;  // error of the sum, relative to the forces
constexpr double INFINITE = std::numeric_limits<double>::infinity();

// Forces of all planets at one wind-up.
struct Sum {
    double force;   // [N]
    double growth;  // [N/m]
    double size;    // sum of magnitudes [N]
};

Sum add_up(double total, std::int64_t planets, const Springs& springs, double w) {
    Sum sum{0.0, 0.0, std::abs(total)};
    for (std::int64_t p = 0; p < planets; ++p) {
        SpringForce one = planet_force(springs, p, w);
        sum.force += springs.copies[p] * one.force;
        sum.growth += springs.copies[p] * one.growth;
        sum.size += springs.copies[p] * std::abs(one.force);
    }
    return sum;
}

}  // namespace

// Newton's method on a sum of increasing piecewise linear functions, within a bracket.
double solve_windup(double total, std::int64_t planets, const Springs& springs) {
    double copies = 0.0;
    for (std::int64_t p = 0; p < planets; ++p) copies += springs.copies[p];
    double low = INFINITE, high = -INFINITE, stiffness = 0.0, w = 0.0, mean = total / copies;
    for (std::int64_t p = 0; p < planets; ++p) {
        double compliance = springs.compliance[p];
        double alone = windup_at(mean, compliance, springs.friction[p], springs.steps[p]);
        alone += springs.error[p];
        low = std::min(low, alone);
        high = std::max(high, alone);
        w += springs.copies[p] * alone / compliance;
        stiffness += springs.copies[p] / compliance;
    }
    w = std::min(std::max(w / stiffness, low), high);
    for (int n = 0; n < MOST_TRIALS; ++n) {
        Sum sum = add_up(total, planets, springs, w);
        if (std::abs(sum.force - total) <= CLOSED * sum.size) break;
        (sum.force < total ? low : high) = w;
        w = sum.growth > 0.0 ? w + (total - sum.force) / sum.growth : INFINITE;
        if (!(low < w && w < high)) {
            w = 0.5 * (low + high);
            if (!(low < w && w < high)) break;  // adjacent floating-point numbers
        }
    }
    return w;
}

}  // namespace gearbox
