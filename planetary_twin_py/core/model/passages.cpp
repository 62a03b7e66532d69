#include "model/passages.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "mesh/cycle.hpp"
#include "model/bearings.hpp"
#include "model/rating_life.hpp"
#include "model/shaft_cycles.hpp"
#include "vector/math.hpp"

namespace gearbox {

namespace {

int place_of(std::int64_t side) {
    return side == DRIVE_SIDE ? 0 : 1;
}

// One over the cycles to failure.
double damage_of(const StressCurve& curve, double log_stress) {
    if (curve.points == 0) return 0.0;
    if (curve.endless && log_stress < curve.log_stress[curve.points - 1]) return 0.0;
    std::int64_t k = 0;
    while (k < curve.points - 2 && log_stress < curve.log_stress[k + 1]) ++k;
    double slope = (curve.log_cycles[k + 1] - curve.log_cycles[k]) /
                   (curve.log_stress[k + 1] - curve.log_stress[k]);
    return exp(-(curve.log_cycles[k] + slope * (log_stress - curve.log_stress[k])));
}

// Place among the peaks of pair p of a segment.
std::int64_t pair_of(const Train& train, std::int64_t kind, std::int64_t segment, std::int64_t p) {
    const double shift = std::floor(train.teeth.shift[kind][segment][p]);
    return static_cast<std::int64_t>(shift) - train.durability.first_pair[kind];
}

// Whole cycles of mesh i at a state, modulo `counted`; `cycles` are those of the train.
std::int64_t whole_cycles(const Train& train, const State& state, const StepConstants& step,
                          std::int64_t i, double cycles) {
    const std::int64_t modulus = train.durability.counted;
    double counted = cycle_on_side(train, i, state.side[i], cycles, modulus);
    auto whole = static_cast<std::int64_t>(std::nearbyint(counted - step.start[i]));
    return (whole % modulus + modulus) % modulus;
}

// Add the passage of a pair of mesh i after `whole` cycles; it begins again without load.
void end_passage(const Train& train, std::int64_t i, int side, std::int64_t whole,
                 std::int64_t pair, Passages& passages, MeshSums& sums) {
    const Durability& durability = train.durability;
    const std::int64_t kind = train.mesh.kind[i];
    double (*stresses)[PAIRS][MESHES] = passages.stress[side];
    double& square = stresses[CONTACT_STRESS][pair][i];
    if (!(square > 0.0)) return;
    Passed found{
        i, side == 0 ? DRIVE_SIDE : COAST_SIDE, whole - durability.first_pair[kind] - pair, 1, 0,
        {}};
    for (int gear = 0; gear < 2; ++gear) {
        const StressCurve &flank = durability.flank[kind + gear],
                          &root = durability.root[kind + gear];
        found.damage[FLANK_DAMAGE + gear] = damage_of(flank, 0.5 * log(square));
        double& stress = stresses[ROOT_STRESS + gear][pair][i];
        if (stress > 0.0) found.damage[ROOT_DAMAGE + gear] = damage_of(root, log(stress));
        stress = 0.0;
    }
    double (*rows)[MESHES] = sums.damage + side * OF_SIDE;
    for (int row = 0; row < PASSAGE; ++row) rows[row][i] += found.damage[row];
    rows[PASSAGE][i] += 1.0;
    if (durability.teeth) sums.passed.push_back(found);
    square = 0.0;
}

// Move the pairs of mesh i by whole cycles; those that leave have passed.
void move_pairs(const Train& train, std::int64_t i, int side, std::int64_t cycles,
                Passages& passages, MeshSums& sums) {
    const std::int64_t before = passages.whole[side][i];
    const std::int64_t pairs = train.durability.pairs[train.mesh.kind[i]];
    const std::int64_t sense = cycles > 0 ? 1 : -1;
    for (std::int64_t n = 0; n < std::min(std::abs(cycles), pairs); ++n) {
        std::int64_t last = sense > 0 ? pairs - 1 : 0;
        end_passage(train, i, side, before + n * sense, last, passages, sums);
        for (std::int64_t k = last; k - sense >= 0 && k - sense < pairs; k -= sense) {
            for (double (*peaks)[MESHES] : passages.stress[side]) {
                peaks[k][i] = peaks[k - sense][i];
                peaks[k - sense][i] = 0.0;
            }
        }
    }
}

// End the passages of pairs of mesh i that are not in its segment of the mesh cycle.
void end_absent_pairs(const Train& train, std::int64_t i, int side, std::int64_t segment,
                      std::int64_t whole, Passages& passages, MeshSums& sums) {
    const std::int64_t kind = train.mesh.kind[i];
    std::uint64_t present = 0;
    for (std::int64_t p = 0; p < train.teeth.present[kind][segment]; ++p)
        present |= std::uint64_t{1} << pair_of(train, kind, segment, p);
    for (std::int64_t pair = 0; pair < train.durability.pairs[kind]; ++pair)
        if ((present >> pair) % 2 == 0) end_passage(train, i, side, whole, pair, passages, sums);
}

void raise_to(double& peak, double value) {
    peak = at_least(peak, value);
}

// Force of a mesh of planet p, signed, and the sum of the magnitudes on both flanks [N].
struct ForceOfMesh {
    double signed_one, size;
};

ForceOfMesh force_of(const Train& train, const StepConstants& step, const MeshesNow& now,
                     std::int64_t kind, std::int64_t p) {
    const std::int64_t first = kind * planets_of(train) + p, half = train.meshes / FLANKS;
    ForceOfMesh found{0.0, 0.0};
    for (std::int64_t i = first; i < train.meshes; i += half) {
        const double force = at_least(now.normal_force[i], 0.0);
        found.signed_one += step.side[i] * force;
        found.size += force;
    }
    return found;
}

// Rates of the bearings of the planets, by the forces of their meshes.
void rate_planets(const Model& model, const StepConstants& step, const MeshesNow& now,
                  double* rate) {
    const Train& train = model.train;
    const Durability& durability = train.durability;
    const double speed = durability.turns_per_cycle * std::fabs(now.cycle_rate);
    for (std::int64_t p = 0; p < planets_of(train); ++p) {
        const ForceOfMesh sun = force_of(train, step, now, 0, p);
        const ForceOfMesh ring = force_of(train, step, now, 1, p);
        const double along =
            sun.signed_one * durability.cosine[0] + ring.signed_one * durability.cosine[1];
        const double across = sun.size * durability.sine[0] - ring.size * durability.sine[1];
        const double load = std::sqrt(along * along + across * across);
        rate[p] = load > 0.0 ? bearing_damage(durability.pin, model.oil, load, speed) : 0.0;
    }
}

// Rates of the bearings of the members, by the forces of their supports in the housing.
void rate_members(const Model& model, const StepConstants& step, const double* x, const double* v,
                  double* rate) {
    const Train& train = model.train;
    for (std::int64_t b = 0; b < MEMBERS; ++b) {
        const SeatRating& seat = train.durability.member[b];
        if (seat.rating == 0.0) continue;
        const double turning = step.rigid[train.moving.frame];
        const auto [along, across] = bearing_force(train, b, turning, x, v).reaction;
        const double load = std::sqrt(along * along + across * across);
        const double speed =
            std::fabs(step.rigid[train.durability.member_body[b]]) / (2.0 * std::numbers::pi);
        rate[b] = load > 0.0 ? bearing_damage(seat, model.oil, load, speed) : 0.0;
    }
}

}  // namespace

void end_passages(const Train& train, const State& state, const StepConstants& step,
                  Passages& passages, MeshSums& sums) {
    const std::int64_t modulus = train.durability.counted;
    const double cycles = frame_cycle(train, state, modulus) + cycle_shift(train, state.x);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (state.side[i] == OPEN) continue;
        const int side = place_of(state.side[i]);
        const std::int64_t whole = whole_cycles(train, state, step, i, cycles);
        std::int64_t &before = passages.whole[side][i], &seen = passages.seen[side][i];
        if (whole == before && seen == 1 + state.segment[i]) continue;
        if (seen != 0) {
            std::int64_t moved = (whole - before + modulus) % modulus;
            if (moved > modulus / 2) moved -= modulus;
            if (moved != 0) move_pairs(train, i, side, moved, passages, sums);
        }
        end_absent_pairs(train, i, side, state.segment[i], whole, passages, sums);
        seen = 1 + state.segment[i];
        before = whole;
    }
}

void keep_peaks(const Model& model, const State& state, const StepPeaks& peaks, Passages& passages,
                MeshSums& sums) {
    const Train& train = model.train;
    const double roughness = exp(model.oil.log_roughness);
    for (std::int64_t i = 0; i < train.meshes; ++i) {
        if (state.side[i] == OPEN) continue;
        const std::int64_t kind = train.mesh.kind[i], segment = state.segment[i];
        const int side = place_of(state.side[i]);
        for (std::int64_t p = 0; p < train.teeth.present[kind][segment]; ++p) {
            const std::int64_t pair = pair_of(train, kind, segment, p);
            for (int row = 0; row < STRESSES; ++row) {
                raise_to(passages.stress[side][row][pair][i], peaks.stress.row[row][p][i]);
                raise_to(sums.extreme[row][i], peaks.stress.row[row][p][i]);
            }
        }
        if (!(peaks.per_film[i] > 0.0)) continue;
        raise_to(sums.extreme[HOTTEST][i], model.oil.temperature[kind] + peaks.flash[i]);
        raise_to(sums.extreme[ROUGHEST][i], roughness * peaks.per_film[i]);
    }
}

bool has_bearings(const Train& train) {
    const Durability& durability = train.durability;
    bool has = durability.pin.rating > 0.0;
    for (const SeatRating& seat : durability.member) has |= seat.rating > 0.0;
    return has;
}

void rate_bearings(const Model& model, const StepConstants& step, const MeshesNow& now,
                   const double* x, const double* v, BearingRates& rate) {
    if (model.train.durability.pin.rating > 0.0) rate_planets(model, step, now, rate.planet);
    if constexpr (MOVING) rate_members(model, step, x, v, rate.member);
}

void add_bearings(const Train& train, const BearingRates& rate, double weight, MeshSums& sums) {
    for (std::int64_t p = 0; p < planets_of(train); ++p)
        sums.damage[BEARING_DAMAGE][p] += weight * rate.planet[p];
    for (std::int64_t b = 0; b < MEMBERS; ++b)
        sums.damage[MEMBER_DAMAGE][b] += weight * rate.member[b];
}

void follow_shafts(const Train& train, const double* torque, Passages& passages, MeshSums& sums) {
    for (std::int64_t c = 0; c < train.machines; ++c) {
        const ShaftCurve& curve = train.durability.shaft[c];
        if (curve.range > 0.0)
            sums.damage[SHAFT_DAMAGE][c] += follow_torque(curve, torque[c], passages.shaft[c]);
    }
}

void skip_cycles(const Train& train, std::int64_t cycles, Passages& passages) {
    const std::int64_t modulus = train.durability.counted;
    for (int side = 0; side < 2; ++side)
        for (std::int64_t i = 0; i < train.meshes; ++i) {
            std::int64_t moved = (side == 0 ? cycles : -cycles) % modulus;
            passages.whole[side][i] = (passages.whole[side][i] + moved + modulus) % modulus;
        }
}

void renumber(const Train& train, const State& state, const StepConstants& step,
              Passages& passages) {
    const std::int64_t modulus = train.durability.counted;
    const double cycles = frame_cycle(train, state, modulus) + cycle_shift(train, state.x);
    for (std::int64_t i = 0; i < train.meshes; ++i)
        if (state.side[i] != OPEN)
            passages.whole[place_of(state.side[i])][i] =
                whole_cycles(train, state, step, i, cycles);
}

void add_passed(const std::vector<Passed>& passed, std::int64_t ahead, std::int64_t times,
                std::int64_t stride, MeshSums& sums) {
    for (Passed each : passed) {
        each.pair += each.side * ahead;
        each.times = times;
        each.stride = each.side * stride;
        sums.passed.push_back(each);
    }
}

void clear_damage(MeshSums& sums) {
    sums.damaging = true;
    sums.passed.clear();
    std::memset(sums.damage, 0, sizeof sums.damage);
    std::memset(sums.extreme, 0, sizeof sums.extreme);
}

}  // namespace gearbox
