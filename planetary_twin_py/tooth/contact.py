"""Local compliance where two flanks touch, per face width.

Not the lubricated contact: how far the flanks approach each other under load.
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
    """Where two flanks touch, each (m,).

    `radius` [m] is the reduced radius of curvature, 1/R = 1/R1 +- 1/R2; `depths` [m] are the
    distances from the contact to the centre lines of the two teeth.
    """

    radius: Floats
    depths: tuple[Floats, Floats]


ContactLaw = Callable[[Contact, Material], Floats]  # approach per load, times contact length


def yang_sun(contact: Contact, material: Material) -> Floats:
    """4 (1 - nu^2)/(pi E) [m^2/N], whatever the load and curvature (Yang and Sun 1985).

    From the half-width of the contact alone: it leaves out most of what the teeth yield between
    flank and centre line, a factor of 2 to 4 on this term.
    """
    return np.full_like(contact.radius, 4.0 / (math.pi * material.plane_strain_modulus))


def weber_banaschek(line_load: float) -> ContactLaw:
    """Approach of the two centre lines per load, at `line_load` [N/m] (Weber and Banaschek 1953).

    For each tooth 2 (1 - nu^2)/(pi E) [ln(2 t/b) - nu/(2 (1 - nu))], t the depth and b the Hertzian
    half-width: the strains below a Hertzian contact. A secant at this load; a tenfold load makes
    a pair about a tenth stiffer.

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
