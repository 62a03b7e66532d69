// Film and friction of many tooth pairs in vector registers.

#include "tribology/tooth_friction.hpp"

namespace gearbox {

namespace {

constexpr std::int64_t BATCH = 8;  // pairs that go through the laws side by side

template <Laws laws>
void evaluate_pairs(const Oil& oil, ToothPairs& pairs) {
    const double slowest = pairs.slowest_rolling;
    for (std::int64_t first = 0; first < pairs.count; first += BATCH) {
#pragma GCC ivdep
        for (std::int64_t k = first; k < first + BATCH; ++k) {
            PairFriction found = tooth_contact<laws>(
                oil,
                {pairs.rho1[k], pairs.rho2[k], pairs.external[k], pairs.speed1[k],
                 pairs.speed2[k], pairs.load[k]},
                slowest);
            pairs.friction[k] = found.friction;
            pairs.boundary[k] = found.boundary;
            pairs.viscous[k] = found.viscous;
            pairs.log_film[k] = found.log_film;
            pairs.sliding[k] = found.sliding;
            pairs.slope[k] = found.slope;
            pairs.rolling[k] = found.rolling;
            pairs.rolling_power[k] = found.rolling_power;
        }
    }
}

}  // namespace

// Whole batches, so that lanes beyond `count` are idle.
void evaluate(const Model& model, ToothPairs& pairs) {
    const Oil& oil = model.oil;
    with_laws(oil, [&]<Laws laws>() { evaluate_pairs<laws>(oil, pairs); });
    if (pairs.held) hold(oil, pairs);
}

}  // namespace gearbox
