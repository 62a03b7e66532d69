"""Viscosity grades of industrial oils (ISO 3448) and their viscosity index (ASTM D2270, ISO 2909).

The number of a grade is its kinematic viscosity at 40 deg C in mm^2/s, the middle of a range of
+-10 %. The viscosity index compares the oil with two series of reference oils that have the same
viscosity Y at 100 deg C: at 40 deg C, those of index 0 have L and those of index 100 have H.
"""

from __future__ import annotations

import math

GRADES = (10, 15, 22, 32, 46, 68, 100, 150, 220, 320, 460, 680, 1000, 1500, 2200, 3200)
"""Grades of ISO 3448 that gears are lubricated with [mm^2/s]."""
COLD, HOT = 313.15, 373.15
"""Temperatures of the two viscosities [K]."""
LOWEST_INDEX, HIGHEST_INDEX = 0.0, 400.0

_LEAST = 2.0  # [mm^2/s] at 100 deg C, from which the index is defined
# ASTM D2270: largest Y [mm^2/s]; a, b, c of L = a Y^2 + b Y + c; d, e, f of H.
_SERIES = (
    (3.8, (1.14673, 1.7576, -0.109), (0.84155, 1.5521, -0.077)),
    (4.4, (3.38095, -15.4952, 33.196), (0.78571, 1.7929, -0.183)),
    (5.0, (2.5000, -7.2143, 13.812), (0.82143, 1.5679, 0.119)),
    (6.4, (0.10100, 16.6350, -45.469), (0.04985, 9.1613, -18.557)),
    (7.0, (3.35714, -23.5643, 78.466), (0.22619, 7.7369, -16.656)),
    (7.7, (0.01191, 21.4750, -72.870), (0.79762, -0.7321, 14.610)),
    (9.0, (0.41858, 16.1558, -56.040), (0.05794, 10.5156, -28.240)),
    (12.0, (0.88779, 7.5527, -16.600), (0.26665, 6.7015, -10.810)),
    (15.0, (0.76720, 10.7972, -38.180), (0.20073, 8.4658, -22.490)),
    (18.0, (0.97305, 5.3135, -2.200), (0.28889, 5.9741, -4.930)),
    (22.0, (0.97256, 5.2500, -0.980), (0.24504, 7.4160, -16.730)),
    (28.0, (0.91413, 7.4759, -21.820), (0.20323, 9.1267, -34.230)),
    (40.0, (0.87031, 9.7157, -50.770), (0.18411, 10.1015, -46.750)),
    (55.0, (0.84703, 12.6752, -133.310), (0.17029, 11.4866, -80.620)),
    (70.0, (0.85921, 11.1009, -83.190), (0.17130, 11.3680, -76.940)),
    (math.inf, (0.83531, 14.6731, -216.246), (0.16841, 11.8493, -96.947)),
)


def cold_viscosity(hot: float, index: float) -> float:
    """Kinematic viscosity at 40 deg C [m^2/s] of an oil.

    Args:
        hot: kinematic viscosity at 100 deg C [m^2/s], at least 2e-6.
        index: viscosity index [-].
    """
    y = 1e6 * hot
    _, zero, hundred = next(row for row in _SERIES if y <= row[0])
    low, high = ((a * y + b) * y + c for a, b, c in (zero, hundred))
    if index <= 100.0:
        return 1e-6 * (low - 0.01 * index * (low - high))
    return 1e-6 * float(high / y ** math.log10(1.0 + 0.00715 * (index - 100.0)))


def hot_viscosity(cold: float, index: float) -> float:
    """Kinematic viscosity at 100 deg C [m^2/s] of an oil, within 1e-9 of it.

    Args:
        cold: kinematic viscosity at 40 deg C [m^2/s].
        index: viscosity index [-], from `LOWEST_INDEX` to `HIGHEST_INDEX`.

    Raises:
        ValueError: the oil is too thin for the index to be defined.
    """
    low, high = 1e-6 * _LEAST, cold
    if cold_viscosity(low, index) > cold:
        raise ValueError(
            f"a viscosity of {1e6 * cold:g} mm^2/s at 40 degC with the index {index:g} is below "
            f"{_LEAST:g} mm^2/s at 100 degC, where the index is not defined"
        )
    while high - low > 1e-9 * low:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if cold_viscosity(middle, index) < cold else (low, middle)
    return low
