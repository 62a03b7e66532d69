"""Quantities of what commands show, by key: they give a table or lines, JSON, and the reference.

Those of messages, studies and plots are in `catalogue`. A record whose fields are annotated with
their quantities is a catalogue of its own, see `quantities_of`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import get_type_hints

from .catalogue import SUMMARY, Quantity

Quantities = Mapping[str, Quantity]


def key_with_unit(name: str, quantity: Quantity) -> str:
    """Key of a figure in the JSON of a command that names the unit, such as "dte_peak_m"."""
    return f"{name}_{quantity.si.replace(' ', '')}".rstrip("_")


def quantities_of(record: type) -> dict[str, Quantity]:
    """Quantities by field of a record, with which its fields are annotated, in their order.

    Args:
        record: class with fields such as `Annotated[float, Quantity("contact ratio")]`.
    """
    hints = get_type_hints(record, include_extras=True)
    return {
        name: quantity
        for name, hint in hints.items()
        for quantity in getattr(hint, "__metadata__", ())
        if isinstance(quantity, Quantity)
    }


RUN = {
    "settling": Quantity("excluded at the start", "s"),
    "efficiency": Quantity("efficiency"),
    "mean_power_loss": Quantity("power loss, mean", "W"),
    "tooth_friction": Quantity("- of tooth friction", "W"),
    "bearing_loss": Quantity("- of bearings, seals and grease", "W"),
    "churning_loss": Quantity("- of churning", "W"),
    **dict(SUMMARY.values()),
    "mesh_frequency": Quantity("mesh frequency, mean", "Hz"),
    "energy_residual": Quantity("energy residual/input energy"),
    "real_time_factor": Quantity("real-time factor"),
}
"""Of a whole run."""
SOURCES = ("tooth_friction", "bearing_loss", "churning_loss")
"""Those of `RUN` that make up the power loss."""

DAMAGE = {
    "shortest_lived": Quantity("part with the shortest life"),
    "hours_to_damage_1": Quantity("hours to its damage of 1"),
    "contact_stress_Pa": Quantity("contact stress after Hertz at the dynamic load, peak", "Pa"),
    "root_stress_Pa": Quantity(
        "root stress by ISO 6336-3 B factors or boundary elements, peak", "Pa"
    ),
    "contact_temperature_K": Quantity("contact temperature (Blok), peak", "K"),
    "specific_film": Quantity("specific film, smallest"),
    "scuffing_margin": Quantity("margin to the scuffing temperature"),
}
"""Of the damage of a run, by keys of its JSON."""
TEMPERATURES = {
    "oil": Quantity("oil at the end", "K"),
    "sun": Quantity("sun at the end", "K"),
    "planets": Quantity("planets at the end", "K"),
    "ring": Quantity("ring at the end", "K"),
    "housing": Quantity("housing at the end", "K"),
    "ambient": Quantity("ambient air", "K"),
}
"""Of a run whose temperatures are states."""
HEAT = {
    "sun_planet_meshes": Quantity("heat of sun-planet meshes", "W"),
    "planet_ring_meshes": Quantity("heat of planet-ring meshes", "W"),
    "bearings": Quantity("heat of bearings", "W"),
    "seals": Quantity("heat of seals and grease", "W"),
    "churning": Quantity("heat of churning", "W"),
}
"""By source, of the same."""

STEADY = {
    "input_torque": Quantity("input torque", "N m"),
    "input_speed": Quantity("input speed", "rad/s"),
    "oil": Quantity("oil", "K"),
    "sun": Quantity("sun", "K"),
    "planets": Quantity("planets", "K"),
    "ring": Quantity("ring", "K"),
    "housing": Quantity("housing", "K"),
    "power_loss": Quantity("power loss", "W"),
    "gain": Quantity("feedback gain"),
    "per_ambient": Quantity("change of the oil per change of the ambient temperature"),
    "time_constant": Quantity("longest time constant of small changes", "s"),
    "stable": Quantity("stable"),
}
"""Of a steady state of the temperatures."""

AXES_OF_RUN = {
    "displacement_mean": Quantity("displacement, magnitude of its mean", "m"),
    "displacement_magnitude": Quantity("displacement, mean of its magnitude", "m"),
    "displacement_peak": Quantity("displacement, peak", "m"),
    "bearing_force_mean": Quantity("force on the bearing, magnitude of its mean", "N"),
    "bearing_force_magnitude": Quantity("force on the bearing, mean of its magnitude", "N"),
    "bearing_force_peak": Quantity("force on the bearing, peak", "N"),
    "axial_displacement_mean": Quantity("axial displacement, mean", "m"),
    "tilt_mean": Quantity("tilt, magnitude of its mean", "rad"),
    "tilt_magnitude": Quantity("tilt, mean of its magnitude", "rad"),
    "thrust_mean": Quantity("thrust on the bearing, mean", "N"),
    "thrust_peak": Quantity("thrust on the bearing, peak", "N"),
    "tilting_moment_mean": Quantity("tilting moment on the bearing, magnitude of its mean", "N m"),
    "tilting_moment_magnitude": Quantity(
        "tilting moment on the bearing, mean of its magnitude", "N m"
    ),
    "tilting_moment_peak": Quantity("tilting moment on the bearing, peak", "N m"),
}
"""Of each axis, where axes move; axial motion, tilts, thrust and moments where they tilt, too."""
SHARES_OF_RUN = {
    "load_share": Quantity("share of the load, mean"),
    "largest_load_share": Quantity("share of the load, largest mean over a mesh cycle"),
}
"""Of each planet, where axes move; the largest of the second is K_gamma."""

_DEGREES = ("deg", math.degrees(1.0))

LOST_MOTION = {
    "largest_torque": Quantity("largest torque on the output", "N m"),
    "lost_motion": Quantity("lost motion at {share:g} % of it", "rad", customary=_DEGREES),
    "hysteresis": Quantity("hysteresis at {share:g} % of it", "rad", customary=_DEGREES),
    "stiffness": Quantity("torsional stiffness, half to full torque", "N m/rad"),
    "stiffness_positive": Quantity("- under positive torque", "N m/rad"),
    "stiffness_negative": Quantity("- under negative torque", "N m/rad"),
    "stiffness_with_couplings": Quantity("stiffness, motor to load with couplings", "N m/rad"),
}
"""Of a test of lost motion."""

ORDERS = {
    "mesh": Quantity("mesh"),
    "sun_turns": Quantity("sun turns"),
    "planet_turns": Quantity("planet turns, in the housing"),
    "ring_turns": Quantity("ring turns"),
    "carrier_turns": Quantity("carrier turns"),
    "planets_pass": Quantity("planets pass a sensor on the housing"),
    "sun_tooth": Quantity("sun tooth, in one mesh"),
    "sun_tooth_all_meshes": Quantity("sun tooth, in the meshes of all planets"),
    "planet_tooth": Quantity("planet tooth, in one mesh; planet on its pin"),
    "planet_tooth_both_meshes": Quantity("planet tooth, at sun and ring"),
    "ring_tooth": Quantity("ring tooth, in one mesh"),
    "ring_tooth_all_meshes": Quantity("ring tooth, in the meshes of all planets"),
}
"""Orders of a gear set, see `fault_orders`."""
