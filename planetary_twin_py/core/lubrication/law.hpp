#pragma once

// Selection of the friction laws, once for all tooth pairs: they are types, with which the loops
// over pairs are compiled.

#include "lubrication/contact.hpp"
#include "lubrication/friction_table.hpp"
#include "lubrication/schlenk.hpp"
#include "lubrication/shear_thinning.hpp"
#include "lubrication/traction.hpp"

namespace gearbox {

template <FrictionLaw... Law>
struct LawList {
    // Call `function.operator()<Law>()` with the law at a position, see `Oil::traction_law`.
    template <class Function>
    static void with(std::int64_t position, Function&& function) {
        std::int64_t k = 0;
        ((k++ == position ? function.template operator()<Law>() : void()), ...);
    }

    // Call `function.operator()<Law>(position)` for each law.
    template <class Function>
    static void each(Function&& function) {
        int position = 0;
        (function.template operator()<Law>(position++), ...);
    }
};

using FrictionLaws = LawList<PlateauLaw, EyringLaw, SchlenkLaw, TableLaw>;

inline bool has_single_precision(const Oil& oil) {
    bool found = false;
    FrictionLaws::with(oil.traction_law, [&]<class Law>() { found = Law::SINGLE_PRECISION; });
    return found;
}

enum class BoundaryLaw {
    NONE,                 // included in the friction law
    SHARING,              // by load sharing, see `load_sharing.hpp`
    SHARING_AT_RATIO,     // the same at the prescribed lambda ratio
    ASPERITIES,           // of Greenwood and Tripp's asperities, see `boundary.hpp`
    PRINTED_ASPERITIES,   // the same with the printed functions
    ASPERITIES_AT_RATIO,  // the same for all pairs, at the prescribed lambda ratio
};

inline BoundaryLaw boundary_law(const Oil& oil) {
    if (oil.sharing) return oil.prescribed ? BoundaryLaw::SHARING_AT_RATIO : BoundaryLaw::SHARING;
    if (oil.prescribed) return BoundaryLaw::ASPERITIES_AT_RATIO;
    return oil.printed_asperities ? BoundaryLaw::PRINTED_ASPERITIES : BoundaryLaw::ASPERITIES;
}

// The laws of a run. `rolling`: whether there is rolling resistance.
template <FrictionLaw Law, BoundaryLaw boundary, bool rolling>
struct Laws {
    using Traction = Law;
    static constexpr BoundaryLaw BOUNDARY = boundary;
    static constexpr bool ROLLING = rolling;
};

template <FrictionLaw Law, BoundaryLaw boundary, class Function>
inline void with_rolling(const Oil& oil, Function&& function) {
    if (oil.rolling)
        function.template operator()<Laws<Law, boundary, true>>();
    else
        function.template operator()<Laws<Law, boundary, false>>();
}

template <FrictionLaw Law, BoundaryLaw... boundary, class Function>
inline void with_boundary_among(const Oil& oil, Function&& function) {
    const BoundaryLaw own = boundary_law(oil);
    ((own == boundary ? with_rolling<Law, boundary>(oil, function) : void()), ...);
}

template <FrictionLaw Law, class Function>
inline void with_traction(const Oil& oil, Function&& function) {
    using enum BoundaryLaw;
    if constexpr (Law::INCLUDES_BOUNDARY)
        return with_rolling<Law, NONE>(oil, function);
    else
        return with_boundary_among<Law, SHARING, SHARING_AT_RATIO, ASPERITIES, PRINTED_ASPERITIES,
                                   ASPERITIES_AT_RATIO>(oil, function);
}

// Call `function.operator()<Laws>()` with the laws of the oil.
template <class Function>
inline void with_laws(const Oil& oil, Function&& function) {
    FrictionLaws::with(oil.traction_law, [&]<class Law>() { with_traction<Law>(oil, function); });
}

}  // namespace gearbox
