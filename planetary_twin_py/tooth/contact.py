"""Local compliance of the contact of two flanks, per face width.

It is the elastic approach of the flanks under load, without lubrication.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .material import Material

Floats = NDArray[np.float64]


class Contact(NamedTuple):
    """Contacts of two flanks."""

    radius: Floats
    """Reduced radius of curvature, 1/R = 1/R1 +- 1/R2 [m], (m,)."""
    depths: tuple[Floats, Floats]
    """Distances from the contact to the centre lines of the two teeth [m], (m,) each."""


ContactLaw = Callable[[Contact, Material], Floats]  # approach/load, times contact length [m^2/N]


def yang_sun(contact: Contact, material: Material) -> Floats:
    """Contact compliance 4 (1 - nu^2)/(pi E) [m^2/N], (m,) (Yang and Sun 1985).

    It does not depend on load and curvature. Because it follows from the half-width of the contact
    alone, it omits most of the deformation between flank and centre line, and is too small by a
    factor of 2 to 4.

    Args:
        contact: contacts of two flanks, (m,).
        material: material of both teeth.
    """
    return np.full_like(contact.radius, 4.0 / (math.pi * material.plane_strain_modulus))


def weber_banaschek(line_load: float) -> ContactLaw:
    """Approach of the two centre lines per load (Weber and Banaschek 1953).

    Each tooth contributes 2 (1 - nu^2)/(pi E) [ln(2 t/b) - nu/(2 (1 - nu))] with the depth t and
    the Hertzian half-width b, from the strains below a Hertzian contact. The law is a secant at the
    given load; a ten times larger load makes a pair about 10 % stiffer.

    Args:
        line_load: load per contact length [N/m].

    Returns:
        The contact law.

    Raises:
        ValueError: the load is not positive.
    """
    if line_load <= 0.0:
        raise ValueError(f"line_load = {line_load:g} N/m: must be above 0")

    def law(contact: Contact, material: Material) -> Floats:
        modulus, nu = material.plane_strain_modulus, material.poisson_ratio
        # 1/E* = 2 (1 - nu^2)/E: the half-width of Johnson (1985), eq. 4.43.
        width = np.sqrt(8.0 * line_load * contact.radius / (math.pi * modulus))
        depths = np.log(2.0 * contact.depths[0] / width) + np.log(2.0 * contact.depths[1] / width)
        return 2.0 / (math.pi * modulus) * (depths - nu / (1.0 - nu))

    return law
