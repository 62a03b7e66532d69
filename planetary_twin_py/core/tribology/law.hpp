#pragma once

// Selection of the friction laws, once for all tooth pairs: they are compile-time constants of the
// loops over pairs.

#include "tribology/oil.hpp"

namespace gearbox {

enum class TractionLaw { PLATEAU, EYRING, SCHLENK, TABLE };  // the values of Oil.traction_law

// Whether a law is available in single precision: the exponents of Eyring's law are beyond its
// range, and tables are read in double precision.
constexpr bool has_single_precision(TractionLaw law) {
    return law == TractionLaw::PLATEAU || law == TractionLaw::SCHLENK;
}

struct NamedLaw {
    const char* name;  // in a scene
    TractionLaw law;
};

constexpr NamedLaw TRACTION_LAWS[] = {
    {"eyring", TractionLaw::EYRING},   {"evans_johnson", TractionLaw::PLATEAU},
    {"printed", TractionLaw::PLATEAU},  // with other constants
    {"schlenk", TractionLaw::SCHLENK},  // with boundary friction
    {"table", TractionLaw::TABLE},      // the same
};

enum class BoundaryLaw {
    NONE,                 // included in Schlenk's regression and in tables
    SHARING,              // by load sharing, see `load_sharing.hpp`
    SHARING_AT_RATIO,     // the same at the prescribed lambda ratio
    ASPERITIES,           // of Greenwood and Tripp's asperities, see `boundary.hpp`
    PRINTED_ASPERITIES,   // the same with the printed functions
    ASPERITIES_AT_RATIO,  // the same for all pairs, at the prescribed lambda ratio
};

struct Laws {
    TractionLaw traction;
    BoundaryLaw boundary;
    bool rolling;  // whether there is rolling resistance
};

inline BoundaryLaw boundary_law(const Oil& oil) {
    auto law = static_cast<TractionLaw>(oil.traction_law);
    if (law == TractionLaw::SCHLENK || law == TractionLaw::TABLE) return BoundaryLaw::NONE;
    if (oil.sharing) return oil.prescribed ? BoundaryLaw::SHARING_AT_RATIO : BoundaryLaw::SHARING;
    if (oil.prescribed) return BoundaryLaw::ASPERITIES_AT_RATIO;
    return oil.printed_asperities ? BoundaryLaw::PRINTED_ASPERITIES : BoundaryLaw::ASPERITIES;
}

// Call `function.operator()<Laws>()` with the laws of the oil.
template <TractionLaw traction, BoundaryLaw boundary, class Function>
inline void with_boundary(const Oil& oil, Function&& function) {
    if (oil.rolling)
        function.template operator()<Laws{traction, boundary, true}>();
    else
        function.template operator()<Laws{traction, boundary, false}>();
}

template <TractionLaw traction, class Function>
inline void with_traction(const Oil& oil, Function&& function) {
    switch (boundary_law(oil)) {
        case BoundaryLaw::SHARING:
            return with_boundary<traction, BoundaryLaw::SHARING>(oil, function);
        case BoundaryLaw::SHARING_AT_RATIO:
            return with_boundary<traction, BoundaryLaw::SHARING_AT_RATIO>(oil, function);
        case BoundaryLaw::PRINTED_ASPERITIES:
            return with_boundary<traction, BoundaryLaw::PRINTED_ASPERITIES>(oil, function);
        case BoundaryLaw::ASPERITIES_AT_RATIO:
            return with_boundary<traction, BoundaryLaw::ASPERITIES_AT_RATIO>(oil, function);
        default:
            return with_boundary<traction, BoundaryLaw::ASPERITIES>(oil, function);
    }
}

template <class Function>
inline void with_laws(const Oil& oil, Function&& function) {
    switch (static_cast<TractionLaw>(oil.traction_law)) {
        case TractionLaw::SCHLENK:
            return with_boundary<TractionLaw::SCHLENK, BoundaryLaw::NONE>(oil, function);
        case TractionLaw::TABLE:
            return with_boundary<TractionLaw::TABLE, BoundaryLaw::NONE>(oil, function);
        case TractionLaw::EYRING:
            return with_traction<TractionLaw::EYRING>(oil, function);
        default:
            return with_traction<TractionLaw::PLATEAU>(oil, function);
    }
}

}  // namespace gearbox
