"""Plotted quantities with their titles and customary units.

Recordings are in SI. Plots use customary units (um, rpm, %), which every title states.
"""

from __future__ import annotations

import math
from typing import NamedTuple

RPM = 30.0 / math.pi


class Quantity(NamedTuple):
    """A plotted quantity: title, unit, and plotted value/SI value."""

    title: str
    unit: str
    factor: float = 1.0

    @property
    def heading(self) -> str:
        """Title with the unit, e.g. "Mesh force, mean [N]"."""
        return f"{self.title} [{self.unit}]"


# Per mesh, by field of GearboxState without the prefix sun_planet_ or planet_ring_.
MESH = {
    "dte_mean": Quantity("DTE, mean", "µm", 1e6),
    "dte_rms": Quantity("DTE, rms of the deviation from the mean", "µm", 1e6),
    "dte_peak": Quantity("DTE, largest magnitude", "µm", 1e6),
    "mesh_force_mean": Quantity("Mesh force, mean", "N"),
    "mesh_force_peak": Quantity("Mesh force, largest magnitude", "N"),
    "contact_fraction": Quantity("Fraction of time in contact", "%", 100.0),
    "film_thickness": Quantity("Film thickness", "µm", 1e6),
    "lambda_ratio": Quantity("Lambda ratio", "-"),
    "boundary_friction": Quantity("Boundary friction", "N"),
    "viscous_friction": Quantity("Viscous friction", "N"),
    "power_loss": Quantity("Power loss per mesh", "W"),
}

# Samples of every mesh, by field of MeshWaveform.
WAVEFORM = {
    "dte": Quantity("DTE", "µm", 1e6),
    "mesh_force": Quantity("Mesh force", "N"),
}

# Of the whole train: the fields of GearboxState that share a plot.
TRAIN = {
    "speed": (
        Quantity("Speed", "rpm", RPM),
        ("sun_speed", "ring_speed", "carrier_speed"),
    ),
    "mesh_frequency": (Quantity("Mesh frequency", "Hz"), ("mesh_frequency",)),
    "power": (Quantity("Power", "W"), ("input_power", "output_power")),
    "power_loss": (Quantity("Power loss, all of the gearbox", "W"), ("power_loss",)),
    "efficiency": (Quantity("Efficiency", "%", 100.0), ("efficiency",)),
}

# By field of OperatingPoint.
OPERATING_POINT = {
    "backlash": Quantity("Backlash", "µm", 1e6),
    "lambda_ratio": Quantity("Prescribed lambda ratio", "-"),
    "oil_temperature": Quantity("Oil temperature", "K"),
    "input_speed": Quantity("Speed set-point", "rpm", RPM),
    "second_input_speed": Quantity("Second speed set-point", "rpm", RPM),
    "input_torque": Quantity("Input torque", "N m"),
    "torque_ripple": Quantity("Torque ripple", "N m"),
}
