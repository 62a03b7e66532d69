// Film and friction of many tooth pairs in vector registers.

#include <cstring>

#include "lubrication/tooth_friction.hpp"

namespace gearbox {

namespace {

ALWAYS_INLINE Lanes load_lanes(const double* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}

ALWAYS_INLINE void store_lanes(double* to, Lanes lanes) {
    std::memcpy(to, &lanes, sizeof lanes);
}

ALWAYS_INLINE Lanes part_of_face(const ToothPairs& pairs, int k) {
    Lanes face = load_lanes(pairs.face + k);
    return face > 0.0 ? face : Lanes{} + 1.0;
}

// Laws are those of the whole face: if only a part is loaded, they use its line load.
ALWAYS_INLINE PairMotion<Lanes> load_motion(const ToothPairs& pairs, int k) {
    return {load_lanes(pairs.rho1 + k),     load_lanes(pairs.rho2 + k),
            load_lanes(pairs.external + k), load_lanes(pairs.speed1 + k),
            load_lanes(pairs.speed2 + k),   load_lanes(pairs.load + k) / part_of_face(pairs, k)};
}

ALWAYS_INLINE void store_friction(const Oil& oil, const PairFriction<Lanes>& found,
                                  ToothPairs& pairs, int k) {
    const Lanes face = part_of_face(pairs, k) * oil.line_length;
    store_lanes(pairs.friction + k, found.friction * face);
    store_lanes(pairs.boundary + k, found.boundary * face);
    store_lanes(pairs.viscous + k, found.viscous * face);
    store_lanes(pairs.log_film + k, found.log_film);
    store_lanes(pairs.sliding + k, found.sliding);
    store_lanes(pairs.slope + k, found.slope * face);
    store_lanes(pairs.rolling + k, found.rolling * face);
    store_lanes(pairs.rolling_power + k, found.rolling_power * face);
}

template <class Laws>
void evaluate_pairs(const Oil& oil, ToothPairs& pairs, int registers) {
    find_pair_friction<Laws, Lanes, PAIR_CAPACITY / WIDTH>(
        oil, registers,
        [&](int r) { return flanks_of(load_motion(pairs, r * WIDTH), oil, pairs.slowest_rolling); },
        [&](int r, const PairFriction<Lanes>& found) {
            store_friction(oil, found, pairs, r * WIDTH);
        });
}

}  // namespace

// Whole registers; lanes beyond `count` are unused.
void evaluate(const Model& model, ToothPairs& pairs) {
    const Oil& oil = model.oil;
    int registers = static_cast<int>((pairs.count + WIDTH - 1) / WIDTH);
    with_laws(oil, [&]<class Laws>() { evaluate_pairs<Laws>(oil, pairs, registers); });
    if (pairs.has_bristles) apply_bristles(oil, pairs);
}

}  // namespace gearbox
