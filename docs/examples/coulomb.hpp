#pragma once

// Dry friction: a share of the normal load, whatever film there is (Coulomb 1785).

#include "lubrication/contact.hpp"

namespace gearbox {

struct CoulombLaw {
    static constexpr const char* NAMES[] = {"coulomb"};
    static constexpr bool INCLUDES_BOUNDARY = true;
    static constexpr const char* USES[] = {"boundary_coefficient"};
    static constexpr bool SINGLE_PRECISION = true;

    template <class Real>
    ALWAYS_INLINE static Friction<Real> friction(const Oil& oil, const Contact<Real>& contact) {
        return {oil.boundary_coefficient * contact.load, Real{}, Real{}};
    }
};

}  // namespace gearbox
