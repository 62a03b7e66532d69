#include "tribology/mesh_friction.hpp"

#include <cstring>

#include "mesh/mesh_forces.hpp"
#include "tribology/tooth_friction.hpp"
#include "vector/floats.hpp"
#include "vector/rows.hpp"

namespace gearbox {

namespace {

// Tooth pairs of all instants as columns of doubles or floats: entry (n * slots + p) * meshes + i
// is of pair p of mesh i at instant n. The lanes of a row beyond the meshes are overwritten by the
// next row, so that few registers hold all pairs; those after the last row have no meaning.
template <class Number>
struct alignas(64) Columns {
    static constexpr int MOST = (MOST_INSTANTS * PAIRS + 1) * MESHES;
    alignas(64) Number rho1[MOST];
    alignas(64) Number rho2[MOST];
    alignas(64) Number external[MOST];
    alignas(64) Number sliding[MOST];
    alignas(64) Number sum[MOST];  // of the surface speeds
    alignas(64) Number load[MOST];
    alignas(64) Number face[MOST];  // part of it in contact
    alignas(64) Number friction[MOST];
    alignas(64) Number rolling[MOST];
    alignas(64) Number rolling_power[MOST];
    alignas(64) Number boundary[MOST];
    alignas(64) Number viscous[MOST];
    alignas(64) Number film[MOST];
};

template <int L>
ALWAYS_INLINE void put(const Row<L>& row, double* column) {
    row.store(column);
}
template <int L>
ALWAYS_INLINE void put(const Row<L>& row, float* column) {
    using Half [[gnu::vector_size(4 * WIDTH)]] = float;
    for (int k = 0; k < Row<L>::PARTS; ++k) {
        Half part = __builtin_convertvector(row.part[k], Half);
        std::memcpy(column + k * WIDTH, &part, sizeof part);
    }
}

// A register of doubles from floats, in one instruction: gcc converts halves of wide registers.
ALWAYS_INLINE Lanes doubles_at(const float* column) {
#if defined(__AVX512F__)
    return _mm512_maskz_cvtps_pd(0xFF, _mm256_loadu_ps(column));
#else
    using Half [[gnu::vector_size(4 * WIDTH)]] = float;
    Half part;
    std::memcpy(&part, column, sizeof part);
    return __builtin_convertvector(part, Lanes);
#endif
}

template <int L>
ALWAYS_INLINE Row<L> get(const double* column) {
    return Row<L>(column);
}
template <int L>
ALWAYS_INLINE Row<L> get(const float* column) {
    Row<L> row;
    for (int k = 0; k < Row<L>::PARTS; ++k) row.part[k] = doubles_at(column + k * WIDTH);
    return row;
}

template <class Number>
struct RegisterOf;
template <>
struct RegisterOf<double> {
    using type = Lanes;
};
template <>
struct RegisterOf<float> {
    using type = Floats;
};

template <class Real, class Number>
ALWAYS_INLINE Real load_register(const Number* column) {
    Real lanes;
    std::memcpy(&lanes, column, sizeof lanes);
    return lanes;
}

template <class Real, class Number>
ALWAYS_INLINE void store_register(Number* column, const Real& lanes) {
    std::memcpy(column, &lanes, sizeof lanes);
}

// Place of the pairs of the first `meshes` meshes in the columns.
struct Stretch {
    std::int64_t first;   // entry
    std::int64_t meshes;  // entries of each pair
};

template <int L, class Number>
ALWAYS_INLINE void place_pairs(const Train& train, const StepConstants& step,
                               const FrictionInstant& instant, Columns<Number>& pairs,
                               const Stretch& place) {
    using V = Row<L>;
    V moved = path_position<L>(train, step, instant.meshes->advance), external(step.external);
    const V spin1(instant.spin[0]), spin2(instant.spin[1]);
    for (std::int64_t p = 0, k = place.first; p < train.slots; ++p, k += place.meshes) {
        auto [rho1, rho2] = flank_radii<L>(step, p, moved);
        auto [sliding, sum] = surface_speeds(rho1, rho2, external, spin1, spin2);
        put(rho1, pairs.rho1 + k);
        put(rho2, pairs.rho2 + k);
        put(external, pairs.external + k);
        put(sliding, pairs.sliding + k);
        put(sum, pairs.sum + k);
        put(V(instant.meshes->load[p]), pairs.load + k);
        put(face_in_contact<L>(step, p, instant.meshes->advance), pairs.face + k);
    }
}

// The same as `tooth_contact`, part by part for all registers.
template <Laws laws, class Number>
void find_pair_friction(const Oil& oil, double slowest, Columns<Number>& pairs, int count) {
    using Real = typename RegisterOf<Number>::type;
    constexpr int IN_ONE = sizeof(Real) / sizeof(Number);
    constexpr int MOST = Columns<Number>::MOST / IN_ONE + 1;
    const double factor = area_factor(oil);
    const int registers = (count + IN_ONE - 1) / IN_ONE;
    Flanks<Real> flanks[MOST];
    Contact<Real> contact[MOST];
    Friction<Real> full[MOST];
    for (int r = 0, k = 0; r < registers; ++r, k += IN_ONE) {
        auto column = [k](const Number* from) { return load_register<Real>(from + k); };
        flanks[r] = flanks_of(column(pairs.rho1), column(pairs.rho2), column(pairs.external),
                              {column(pairs.sliding), column(pairs.sum)},
                              column(pairs.load) / column(pairs.face), oil.line_length,
                              oil.sliding_threshold, slowest);
    }
    for (int r = 0; r < registers; ++r)
        contact[r] = contact_of(oil, factor, flanks[r], logarithms_of(flanks[r]));
    for (int r = 0; r < registers; ++r) full[r] = mixed_friction<laws>(oil, contact[r]);
    for (int r = 0, k = 0; r < registers; ++r, k += IN_ONE) {
        PairFriction<Real> found = sliding_friction<laws>(oil, flanks[r], contact[r], full[r]);
        if constexpr (laws.rolling) {
            add_rolling(oil, flanks[r], contact[r], found);
            store_register(pairs.rolling + k, found.rolling);
            store_register(pairs.rolling_power + k, found.rolling_power);
        }
        store_register(pairs.friction + k, found.friction);
        store_register(pairs.boundary + k, found.boundary);
        store_register(pairs.viscous + k, found.viscous);
        // The exponential may have a rounding error.
        store_register(pairs.film + k, at_least(exp(found.log_film), Real{} + THINNEST_FILM));
    }
}

// Add up the torques of the pairs of each mesh: -f dVs/dw and -F_R d(u1 + u2)/dw of both gears, u1
// and u2 the surface speeds.
template <int L, class Number>
ALWAYS_INLINE void add_up(const Train& train, const StepConstants& step, const Oil& oil,
                          const Columns<Number>& pairs, const Stretch& place,
                          const FrictionInstant& instant) {
    using V = Row<L>;
    MeshFriction& out = *instant.found;
    V moved = path_position<L>(train, step, instant.meshes->advance), external(step.external);
    V torque1(0.0), torque2(0.0), lost(0.0), boundary(0.0), viscous(0.0), film(0.0);
    const V spin1(instant.spin[0]), spin2(instant.spin[1]);
    for (std::int64_t p = 0, k = place.first; p < train.slots; ++p, k += place.meshes) {
        auto [rho1, rho2] = flank_radii<L>(step, p, moved);
        auto [sliding, sum] = surface_speeds(rho1, rho2, external, spin1, spin2);
        const V face = oil.line_length * face_in_contact<L>(step, p, instant.meshes->advance);
        V friction = face * get<L>(pairs.friction + k), resistance(0.0);
        lost += friction * sliding;
        if (oil.rolling) {
            resistance = face * get<L>(pairs.rolling + k);
            lost += face * get<L>(pairs.rolling_power + k);
        }
        torque1 -= (friction + resistance) * rho1;
        torque2 -= (friction - resistance) * external * rho2;
        boundary += face * get<L>(pairs.boundary + k);
        viscous += face * get<L>(pairs.viscous + k);
        film += V(instant.meshes->share[p]) * get<L>(pairs.film + k);
    }
    const Mask<L> used = first_of_row<L>(place.meshes);
    torque1 = select(used, torque1, 0.0);
    torque2 = select(used, torque2, 0.0);
    lost = select(used, lost, 0.0);
    torque1.store(out.drag.torque[0]);
    torque2.store(out.drag.torque[1]);
    (V(0.0) - (torque1 + torque2)).store(out.drag.torque[2]);
    lost.store(out.drag.power);
    lost.store(out.lost);
    select(used, boundary, 0.0).store(out.boundary);
    select(used, viscous, 0.0).store(out.viscous);
    select(used, film, 0.0).store(out.film);
}

// Friction of the first `meshes` meshes.
template <int L, class Number>
void find(const Model& model, const StepConstants& step, const FrictionInstant* instants, int count,
          std::int64_t meshes) {
    const Train& train = model.train;
    const Oil& oil = model.oil;
    const std::int64_t of_instant = train.slots * meshes;
    Columns<Number> pairs;
    for (int n = 0; n < count; ++n)
        place_pairs<L>(train, step, instants[n], pairs, {n * of_instant, meshes});
    with_laws(oil, [&]<Laws laws>() {
        constexpr bool SINGLE = std::is_same_v<Number, float>;
        if constexpr (!SINGLE || has_single_precision(laws.traction))
            find_pair_friction<laws>(oil, slowest_rolling(train, step), pairs,
                                     static_cast<int>(count * of_instant));
    });
    for (int n = 0; n < count; ++n)
        add_up<L>(train, step, oil, pairs, {n * of_instant, meshes}, instants[n]);
}

// Number of the first meshes that contain all closed ones. If each flank has an entry, those of the
// loaded flanks are often the first ones.
std::int64_t count_closed(const Train& train, const StepConstants& step) {
    std::int64_t closed = train.meshes;
    if constexpr (MOVING)
        while (closed > 1 && step.side[closed - 1] == 0.0) --closed;
    return closed;
}

// Call `function` with the number of lanes that these meshes need.
template <class Function>
void with_lanes_of(const Train& train, std::int64_t meshes, Function&& function) {
    constexpr int FIRST = 8;
    if (MOVING && meshes <= FIRST) return function(std::integral_constant<int, FIRST>{});
    with_mesh_lanes(train, function);
}

// Set the friction of entries beyond the first `lanes` to zero.
void clear_beyond(const Train& train, int lanes, MeshFriction& found) {
    const std::int64_t count = mesh_lanes(train);
    const Row<FEW_LANES> zero(0.0);
    for (std::int64_t i = lanes; i < count; i += FEW_LANES)
        for (double* row :
             {found.drag.torque[0], found.drag.torque[1], found.drag.torque[2], found.drag.power,
              found.lost, found.boundary, found.viscous, found.film})
            zero.store(row + i);
}

}  // namespace

void find_friction(const Model& model, const StepConstants& step, const FrictionInstant* instants,
                   int count, bool single_precision) {
    single_precision &= has_single_precision(static_cast<TractionLaw>(model.oil.traction_law));
    const std::int64_t meshes = count_closed(model.train, step);
    with_lanes_of(model.train, meshes, [&]<int L>(std::integral_constant<int, L>) {
        if (single_precision)
            find<L, float>(model, step, instants, count, meshes);
        else
            find<L, double>(model, step, instants, count, meshes);
        if constexpr (MOVING)
            for (int n = 0; n < count; ++n) clear_beyond(model.train, L, *instants[n].found);
    });
}

}  // namespace gearbox
