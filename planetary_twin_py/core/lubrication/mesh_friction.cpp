#include "lubrication/mesh_friction.hpp"

#include <cstring>

#include "lubrication/contact_heat.hpp"
#include "lubrication/tooth_friction.hpp"
#include "mesh/mesh_forces.hpp"
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
    alignas(64) Number radius[MOST];  // reduced, of the contact line
    alignas(64) Number sliding[MOST];
    alignas(64) Number sum[MOST];  // of the surface speeds
    alignas(64) Number load[MOST];
    alignas(64) Number viscosity[MOST];  // its logarithm over that of the oil
    alignas(64) Number face[MOST];       // part of it in contact
    alignas(64) Number friction[MOST];
    alignas(64) Number rolling[MOST];
    alignas(64) Number boundary[MOST];
    alignas(64) Number viscous[MOST];
    alignas(64) Number film[MOST];
    alignas(64) Number flash[MOST];  // where damage is counted
    alignas(64) Number per_film[MOST];
};

template <int L>
ALWAYS_INLINE void put(const Row<L>& row, double* column) {
    row.store(column);
}
template <int L>
ALWAYS_INLINE void put(const Row<L>& row, float* column) {
    for (int k = 0; k < Row<L>::PARTS; ++k) {
        HalfRegister part = __builtin_convertvector(row.part[k], HalfRegister);
        std::memcpy(column + k * WIDTH, &part, sizeof part);
    }
}

template <int L>
ALWAYS_INLINE Row<L> get(const double* column) {
    return Row<L>(column);
}
template <int L>
ALWAYS_INLINE Row<L> get(const float* column) {
    Row<L> row;
    for (int k = 0; k < Row<L>::PARTS; ++k) row.part[k] = vector::doubles_at(column + k * WIDTH);
    return row;
}

template <class Number>
using RegisterOf = std::conditional_t<std::is_same_v<Number, float>, Floats, Lanes>;

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

// Radii of both flanks of the tooth pairs at an instant [m].
template <int L>
struct alignas(64) RadiiOfPairs {
    double first[PAIRS][L], second[PAIRS][L];
};

// 1/m of each mesh, see `distance_of`, times the length of the contact line in face widths.
template <int L>
ALWAYS_INLINE Row<L> inverse_distance(const StepConstants& step, const Oil& oil) {
    using V = Row<L>;
    return oil.line_length / distance_of(V(step.rho1[0]), V(step.rho2[0]), V(step.external));
}

// Fill all columns except `face`. `inverse` comes from `inverse_distance`.
template <int L, class Number>
ALWAYS_INLINE void place_pairs(const Train& train, const StepConstants& step, const Oil& oil,
                               const FrictionInstant& instant, const Row<L>& inverse,
                               const Stretch& place, RadiiOfPairs<L>& radii,
                               Columns<Number>& pairs) {
    using V = Row<L>;
    const V moved = path_position<L>(train, step, instant.meshes->advance);
    const V external(step.external), spin1(instant.spin[0]), spin2(instant.spin[1]);
    const V viscosity = select(external > 0.0, V(oil.log_viscosity[0]), oil.log_viscosity[1]);
    for (std::int64_t p = 0, k = place.first; p < train.teeth.slots; ++p, k += place.meshes) {
        auto [rho1, rho2] = flank_radii<L>(step, p, moved);
        auto [sliding, sum] = surface_speeds(rho1, rho2, external, spin1, spin2);
        rho1.store(radii.first[p]);
        rho2.store(radii.second[p]);
        put(rho1 * rho2 * inverse, pairs.radius + k);
        put(sliding, pairs.sliding + k);
        put(sum, pairs.sum + k);
        put(V(instant.meshes->load[p]), pairs.load + k);
        put(viscosity, pairs.viscosity + k);
    }
}

// Whether the contact lines are on the whole face, all the time.
bool is_spur(const Oil& oil) {
    return oil.line_length == 1.0;
}

template <int L, class Number>
ALWAYS_INLINE void place_faces(const Train& train, const StepConstants& step,
                               const FrictionInstant& instant, const Stretch& place,
                               Columns<Number>& pairs) {
    for (std::int64_t p = 0, k = place.first; p < train.teeth.slots; ++p, k += place.meshes)
        put(face_in_contact<L>(step, p, instant.meshes->advance), pairs.face + k);
}

// Call `function` with the first entry of each register of `count` entries.
template <class Number, class Function>
ALWAYS_INLINE void for_registers(int count, Function&& function) {
    constexpr int IN_ONE = sizeof(RegisterOf<Number>) / sizeof(Number);
    for (int k = 0; k < count; k += IN_ONE) function(k);
}

// The laws are those of the whole face: if only a part is loaded, they use its line load.
template <class Number>
NOINLINE void spread_over_faces(Columns<Number>& pairs, int count) {
    using Real = RegisterOf<Number>;
    for_registers<Number>(count, [&](int k) {
        Real face = load_register<Real>(pairs.face + k);
        store_register(pairs.load + k, load_register<Real>(pairs.load + k) / face);
    });
}

// Multiply forces of the whole face by the lengths of the contact lines in face widths.
template <class Number>
NOINLINE void scale_by_lines(const Oil& oil, const Number* face, int count, Number* force) {
    using Real = RegisterOf<Number>;
    for_registers<Number>(count, [&](int k) {
        Real length = oil.line_length * load_register<Real>(face + k);
        store_register(force + k, load_register<Real>(force + k) * length);
    });
}

template <class Number>
void scale_forces(const Oil& oil, Columns<Number>& pairs, int count) {
    for (Number* force : {pairs.friction, pairs.boundary, pairs.viscous})
        scale_by_lines(oil, pairs.face, count, force);
    if (oil.rolling) scale_by_lines(oil, pairs.face, count, pairs.rolling);
}

template <class Laws, class Number>
void evaluate_columns(const Oil& oil, double slowest, Columns<Number>& pairs, int count) {
    using Real = RegisterOf<Number>;
    constexpr int IN_ONE = sizeof(Real) / sizeof(Number);
    constexpr int MOST = Columns<Number>::MOST / IN_ONE + 1;
    auto flanks_at = [&](int r) {
        auto column = [&](const Number* from) { return load_register<Real>(from + r * IN_ONE); };
        return flanks_of(column(pairs.radius), {column(pairs.sliding), column(pairs.sum)},
                         column(pairs.load), column(pairs.viscosity), oil.sliding_threshold,
                         slowest);
    };
    auto store = [&](int r, const PairFriction<Real>& found) {
        const int k = r * IN_ONE;
        if constexpr (Laws::ROLLING) store_register(pairs.rolling + k, found.rolling);
        store_register(pairs.friction + k, found.friction);
        store_register(pairs.boundary + k, found.boundary);
        store_register(pairs.viscous + k, found.viscous);
        // The exponential may have a rounding error.
        store_register(pairs.film + k, at_least(exp(found.log_film), Real{} + THINNEST_FILM));
    };
    find_pair_friction<Laws, Real, MOST>(oil, (count + IN_ONE - 1) / IN_ONE, flanks_at, store);
}

// Write torques on gears and line of action, and the power that they take from the gears, of the
// meshes in `used`.
template <int L>
ALWAYS_INLINE void put_torques(const FrictionInstant& instant, const Mask<L>& used,
                               const Row<L>& torque1, const Row<L>& torque2) {
    DragOfMeshes& drag = instant.found->drag;
    const Row<L> spin1(instant.spin[0]), spin2(instant.spin[1]);
    const Row<L> lost = select(used, -(torque1 * spin1 + torque2 * spin2), 0.0);
    select(used, torque1, 0.0).store(drag.torque[0]);
    select(used, torque2, 0.0).store(drag.torque[1]);
    select(used, -(torque1 + torque2), 0.0).store(drag.torque[2]);
    lost.store(drag.power);
    lost.store(instant.found->lost);
}

// Sums over the pairs of each mesh: force times radius of both flanks [N m].
template <int L, class Number>
ALWAYS_INLINE RowPair<L> moments(std::int64_t slots, const Number* force, const Stretch& place,
                                 const RadiiOfPairs<L>& radii) {
    using V = Row<L>;
    RowPair<L> sum{0.0, 0.0};
    for (std::int64_t p = 0, k = place.first; p < slots; ++p, k += place.meshes) {
        const V of_pair = get<L>(force + k);
        sum.first += of_pair * V(radii.first[p]);
        sum.second += of_pair * V(radii.second[p]);
    }
    return sum;
}

// Add up the torques of the pairs of each mesh: -f dVs/dw and -F_R d(u1 + u2)/dw of both gears, u1
// and u2 the surface speeds.
template <int L, class Number>
ALWAYS_INLINE void add_up_torques(const Train& train, const StepConstants& step, bool has_rolling,
                                  const Columns<Number>& pairs, const Stretch& place,
                                  const RadiiOfPairs<L>& radii, const FrictionInstant& instant) {
    auto [moment1, moment2] = moments(train.teeth.slots, pairs.friction, place, radii);
    if (has_rolling) {
        auto [rolling1, rolling2] = moments(train.teeth.slots, pairs.rolling, place, radii);
        moment1 += rolling1;
        moment2 -= rolling2;
    }
    put_torques(instant, first_of_row<L>(place.meshes), -moment1, -Row<L>(step.external) * moment2);
}

// Add up parts of friction, and films weighted by load.
template <int L, class Number>
ALWAYS_INLINE void add_up_parts(const Train& train, const Columns<Number>& pairs,
                                const Stretch& place, const FrictionInstant& instant) {
    using V = Row<L>;
    V boundary(0.0), viscous(0.0), film(0.0);
    for (std::int64_t p = 0, k = place.first; p < train.teeth.slots; ++p, k += place.meshes) {
        boundary += get<L>(pairs.boundary + k);
        viscous += get<L>(pairs.viscous + k);
        film += V(instant.meshes->share[p]) * get<L>(pairs.film + k);
    }
    const Mask<L> used = first_of_row<L>(place.meshes);
    select(used, boundary, 0.0).store(instant.found->boundary);
    select(used, viscous, 0.0).store(instant.found->viscous);
    select(used, film, 0.0).store(instant.found->film);
}

// Flash temperatures and films of all pairs, from loads and friction of whole faces.
template <class Number>
NOINLINE void find_heat(double heat, Columns<Number>& pairs, int count) {
    using Real = RegisterOf<Number>;
    for_registers<Number>(count, [&](int k) {
        auto column = [&](const Number* from) { return load_register<Real>(from + k); };
        const Real load = column(pairs.load);
        store_register(pairs.flash + k,
                       flash_temperature(heat, column(pairs.friction), column(pairs.sliding),
                                         column(pairs.sum), column(pairs.radius), load));
        store_register(pairs.per_film + k, inverse_film(column(pairs.film), load));
    });
}

// Highest flash temperature and thinnest film of each mesh.
template <int L, class Number>
void add_up_heat(const Train& train, const Columns<Number>& pairs, const Stretch& place,
                 const FrictionInstant& instant) {
    using V = Row<L>;
    V flash(0.0), per_film(0.0);
    for (std::int64_t p = 0, k = place.first; p < train.teeth.slots; ++p, k += place.meshes) {
        flash = larger(flash, get<L>(pairs.flash + k));
        per_film = larger(per_film, get<L>(pairs.per_film + k));
    }
    const Mask<L> used = first_of_row<L>(place.meshes);
    select(used, flash, 0.0).store(instant.found->flash);
    select(used, per_film, 0.0).store(instant.found->per_film);
}

// Friction of the first `meshes` meshes.
template <int L, class Number>
void find(const Model& model, const StepConstants& step, const FrictionInstant* instants, int count,
          std::int64_t meshes) {
    const Train& train = model.train;
    const Oil& oil = model.oil;
    const bool spur = is_spur(oil);
    const std::int64_t of_instant = train.teeth.slots * meshes;
    const int all = static_cast<int>(count * of_instant);
    const Row<L> inverse = inverse_distance<L>(step, oil);
    auto place = [=](int n) { return Stretch{n * of_instant, meshes}; };
    Columns<Number> pairs;
    RadiiOfPairs<L> radii[MOST_INSTANTS];
    for (int n = 0; n < count; ++n)
        place_pairs<L>(train, step, oil, instants[n], inverse, place(n), radii[n], pairs);
    for (int n = 0; !spur && n < count; ++n)
        place_faces<L>(train, step, instants[n], place(n), pairs);
    if (!spur) spread_over_faces(pairs, all);
    with_laws(oil, [&]<class Laws>() {
        constexpr bool SINGLE = std::is_same_v<Number, float>;
        if constexpr (!SINGLE || Laws::Traction::SINGLE_PRECISION)
            evaluate_columns<Laws>(oil, slowest_rolling(train, step), pairs, all);
    });
    if (train.durability.active) {
        find_heat(train.durability.heat, pairs, all);
        for (int n = 0; n < count; ++n) add_up_heat<L>(train, pairs, place(n), instants[n]);
    }
    if (!spur) scale_forces(oil, pairs, all);
    for (int n = 0; n < count; ++n) {
        add_up_torques(train, step, oil.rolling, pairs, place(n), radii[n], instants[n]);
        add_up_parts<L>(train, pairs, place(n), instants[n]);
    }
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
    if constexpr (MOVING) {
        if (meshes <= 8) return function(std::integral_constant<int, 8>{});
        if (meshes <= 16) return function(std::integral_constant<int, 16>{});
        function(std::integral_constant<int, MESHES>{});
    } else {
        with_mesh_lanes(train, function);
    }
}

// Set the friction of entries beyond the first `lanes` to zero.
void clear_beyond(const Train& train, int lanes, MeshFriction& found) {
    const std::int64_t count = mesh_lanes(train);
    const Row<FEW_LANES> zero(0.0);
    for (std::int64_t i = lanes; i < count; i += FEW_LANES)
        for (double* row :
             {found.drag.torque[0], found.drag.torque[1], found.drag.torque[2], found.drag.power,
              found.lost, found.boundary, found.viscous, found.film, found.flash, found.per_film})
            zero.store(row + i);
}

}  // namespace

void find_friction(const Model& model, const StepConstants& step, const FrictionInstant* instants,
                   int count, bool single_precision) {
    single_precision &= has_single_precision(model.oil);
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
