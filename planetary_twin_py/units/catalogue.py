"""The catalogue of quantities: name, title, description, SI unit, and customary unit of plots.

Messages, tables, studies, plots and views take the quantities from here. A quantity is computed in
`window` (statistics and powers), and its type is in the message definition; no other file lists it.
Recordings and tables are in SI. Plots use customary units (um, rpm, %), which every title states.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Literal, NamedTuple

if TYPE_CHECKING:  # commands read the catalogue before they run, without NumPy
    import numpy as np

RPM = 30.0 / math.pi
CUSTOMARY = {"m": ("µm", 1e6), "rad/s": ("rpm", RPM), "": ("-", 1.0)}
"""Customary unit and customary value/SI value by SI unit; other units are customary themselves."""
SIDES = ("sun_planet", "planet_ring")
"""Kinds of meshes, by prefix of a field."""


class Quantity(NamedTuple):
    """A quantity of plots and tables."""

    title: str
    """Of a plot."""
    si: str = ""
    """SI unit, empty for a dimensionless number."""
    description: str = ""
    """Of a column of a table; empty if the title says it all."""
    customary: tuple[str, float] | None = None
    """Unit of plots, and plotted value/SI value; None is that of `CUSTOMARY`."""
    over_meshes: Literal["mean", "max", "min", "sum"] = "mean"
    """What is shown of the values of the meshes of one kind."""

    def of_meshes(self, values: np.ndarray) -> float:
        """One value for several meshes, or bodies.

        Args:
            values: of each of them, (n,).
        """
        return float(getattr(values, self.over_meshes)())

    @property
    def unit(self) -> str:
        """Unit of plots."""
        return self._plotted[0]

    @property
    def factor(self) -> float:
        """Plotted value/SI value."""
        return self._plotted[1]

    @property
    def heading(self) -> str:
        """Title with the unit of plots, e.g. "Mesh force, mean [N]"."""
        return f"{self.title} [{self.unit}]"

    @property
    def text(self) -> str:
        """Description, or else the title."""
        return self.description or self.title

    @property
    def _plotted(self) -> tuple[str, float]:
        return self.customary or CUSTOMARY.get(self.si, (self.si, 1.0))


PERCENT = ("%", 100.0)

TRAIN = {
    "mesh_frequency": Quantity("Mesh frequency", "Hz", "rate at which teeth pass a mesh"),
    "input_speed": Quantity("Speed of the motor", "rad/s"),
    "input_torque": Quantity("Torque of the motor", "N m"),
    "second_input_speed": Quantity("Speed of the second motor", "rad/s"),
    "second_input_torque": Quantity("Torque of the second motor", "N m"),
    "output_speed": Quantity("Speed of the load", "rad/s"),
    "output_torque": Quantity("Torque of the load", "N m"),
    "input_power": Quantity("Input power", "W", "from the motors into the train, mean"),
    "output_power": Quantity("Output power", "W", "from the train into the load, mean"),
    "power_loss": Quantity("Power loss", "W", "tooth friction, bearings, seals and churning, mean"),
    "stored_power": Quantity(
        "Stored power", "W", "increase of kinetic and elastic energy per second"
    ),
    "efficiency": Quantity(
        "Efficiency", "", "1 - power loss/power of the driving machines", PERCENT
    ),
}
"""Of the whole train: fields of GearboxState, properties of `Window`."""

MESH = {
    "dte_mean": Quantity("DTE, mean", "m"),
    "dte_rms": Quantity(
        "DTE, rms of the deviation from the mean", "m",
        "DTE, rms of the deviation from the mean, largest", over_meshes="max",
    ),
    "dte_peak": Quantity("DTE, peak", "m", over_meshes="max"),
    "mesh_force_mean": Quantity("Mesh force, mean", "N", "mesh force, mean"),
    "mesh_force_peak": Quantity("Mesh force, peak", "N", "mesh force, peak", over_meshes="max"),
    "contact_fraction": Quantity(
        "Fraction of time in contact", "", "fraction of time in contact, smallest", PERCENT, "min"
    ),
    "film_thickness": Quantity("Film thickness", "m", "film thickness in contact, mean"),
    "lambda_ratio": Quantity(
        "Lambda ratio", "", "lambda ratio (specific film thickness) in contact, mean"
    ),
    "boundary_friction": Quantity("Boundary friction", "N", "boundary friction of a mesh, mean"),
    "viscous_friction": Quantity("Viscous friction", "N", "viscous friction of a mesh, mean"),
    "power_loss": Quantity(
        "Tooth friction loss", "W", "tooth friction of all meshes of this kind, mean",
        over_meshes="sum",
    ),
}  # fmt: skip
"""Statistics of a mesh: fields of GearboxState after a prefix of `SIDES`, see `by_name`."""

SUMMARY = {
    "dte_mean": ("mean_dte", Quantity("DTE of all meshes, mean", "m")),
    "dte_rms": ("dte_vibration_rms", Quantity("DTE of all meshes, rms about the mean", "m")),
    "dte_peak": ("dte_peak", Quantity("DTE of any mesh, peak", "m", over_meshes="max")),
    "mesh_force_mean": ("mean_mesh_force", Quantity("force of all meshes, mean", "N")),
    "mesh_force_peak": (
        "mesh_force_peak", Quantity("force of any mesh, peak", "N", over_meshes="max")
    ),
}  # fmt: skip
"""Those of `MESH` that sum up a run: the JSON name without its unit, and the quantity over all
meshes."""
FIGURES = (*SUMMARY, "power_loss")
"""What a run is compared by: with another dynamics, or without a term of the model."""

TRAIN_PLOTS = {
    "speed": (Quantity("Speed", "rad/s"), ("sun_speed", "ring_speed", "carrier_speed")),
    "mesh_frequency": (TRAIN["mesh_frequency"], ("mesh_frequency",)),
    "power": (Quantity("Power", "W"), ("input_power", "output_power")),
    "power_loss": (Quantity("Power loss, all of the gearbox", "W"), ("power_loss",)),
    "efficiency": (TRAIN["efficiency"], ("efficiency",)),
}
"""Fields of GearboxState that share a plot of a recording, by name of the plot."""

WAVEFORM = {
    "dte": Quantity("DTE", "m", "dynamic transmission error along the line of action"),
    "mesh_force": Quantity("Mesh force", "N", "normal force, negative on the coast flanks"),
    "friction": Quantity("Friction", "N", "magnitude of boundary plus viscous friction"),
}
"""Samples of every mesh, as in the core: fields of MeshWaveform, attributes of `MeshSamples`."""
WAVEFORM_VIEWS = ("dte", "mesh_force")
"""Those that a view of a recording shows."""

LUBRICATION = (
    "film_thickness", "lambda_ratio", "boundary_friction", "viscous_friction", "power_loss",
)  # fmt: skip
"""Statistics of a mesh that a simulated result has at every sample, too."""
SAMPLED = (*WAVEFORM_VIEWS, *LUBRICATION)
"""Arrays over samples and meshes in a file of a result: attributes of `Result`."""

OVERVIEW = ("dte", ("boundary_friction", "viscous_friction"))
"""Of `WAVEFORM` and of `MESH` on the first page of a view."""
PAGES = {
    "Transmission error": ("dte", ("dte_mean", "dte_peak", "dte_rms")),
    "Mesh force": ("mesh_force", ("mesh_force_mean", "contact_fraction")),
    "Lubrication": (None, LUBRICATION),
}
"""The same on further pages, by title."""

MEMBERS = ("sun", "ring", "carrier")
"""Central bodies, by prefix of a field."""
COMPONENTS = dict.fromkeys(MEMBERS, ("x", "y")) | {"planet": ("radial", "tangential")}
"""Names of the components of a displacement or force, by kind of body."""

_FROM = "of a planet from its nominal place, without the error of its pin"

BEARING = {
    "displacement": Quantity("Displacement of the axis, mean", "m", _FROM),
    "displacement_peak": Quantity("Displacement of the axis, peak", "m", _FROM),
    "bearing_force": Quantity("Force on the bearing, mean", "N"),
    "bearing_force_peak": Quantity("Force on the bearing, peak", "N"),
}
"""Statistics of an axis that moves, see `axes_statistics`: fields of AxesState after a prefix of
`COMPONENTS` and, of a vector, before a component."""

ORBIT = {"orbit": Quantity("Displacement of the axis in the housing", "m")}
"""Of sun, ring and carrier only, in the same way."""

SHARING = {
    "load_sharing_factor": Quantity("Load sharing factor", "", "largest load share of a planet"),
    "load_share": Quantity(
        "Load share", "", "mean torque of a planet from the sun over that of all planets"
    ),
}
"""How planets share the load: fields of AxesState."""

FLANKS = {
    "drive_force": Quantity("Force of drive flanks, mean", "N"),
    "coast_force": Quantity("Force of coast flanks, mean", "N"),
}
"""Of both flanks of a mesh whose axes move: fields of AxesState after a prefix of `SIDES`."""

AXES_WAVEFORM = {
    "displacement": Quantity("Displacement of the axis", "m", _FROM),
    "bearing_force": Quantity("Force on the bearing", "N"),
    "orbit": Quantity("Displacement of the axis in the housing", "m"),
}
"""Samples of every axis: fields of AxesWaveform."""
VECTORS = frozenset(AXES_WAVEFORM)
"""Those of the quantities of an axis that have two components."""


def axes_fields() -> dict[str, Quantity]:
    """Quantities of AxesState by field, in the order of the message."""
    found = dict(SHARING)
    for side in SIDES:
        for name, quantity in FLANKS.items():
            found[f"{side}_{name}"] = _titled(quantity, side_title(side))
    for body, components in COMPONENTS.items():
        for name, quantity in (BEARING | (ORBIT if body in MEMBERS else {})).items():
            if name not in VECTORS:
                found[f"{body}_{name}"] = _titled(quantity, body)
                continue
            for component in components:
                found[f"{body}_{name}_{component}"] = _titled(quantity, f"{body}, {component}")
    return found


def _titled(quantity: Quantity, of: str) -> Quantity:
    return quantity._replace(title=f"{quantity.title}, {of}")


OPERATING_POINT = {
    "backlash": Quantity("Backlash", "m"),
    "lambda_ratio": Quantity("Prescribed lambda ratio"),
    "oil_temperature": Quantity("Oil temperature", "K"),
    "ambient_temperature": Quantity("Ambient temperature", "K"),
    "input_speed": Quantity("Speed set-point", "rad/s"),
    "second_input_speed": Quantity("Second speed set-point", "rad/s"),
    "input_torque": Quantity("Input torque", "N m"),
    "torque_ripple": Quantity("Torque ripple", "N m"),
}
"""Fields of OperatingPoint."""


def _study() -> dict[str, Quantity]:
    """Columns of the results of a study, in order."""
    found = {name: TRAIN[name] for name in STUDIED}
    for side in SIDES:
        meshes = side_title(side)
        for name, quantity in MESH.items():
            found[f"{side}_{name}"] = quantity._replace(
                title=f"{quantity.title}, {meshes}", description=f"{meshes} meshes: {quantity.text}"
            )
    for side in SIDES:
        found[f"{side}_{CLIPPED}"] = Quantity(
            f"Clipped viscous friction, {side_title(side)}",
            description=f"{side_title(side)} meshes: fraction of the time in contact in which "
            "viscous friction is clipped to zero because the pressure is too low for its law",
        )
    return found | {SPEED_SHARE: SPEED, EXCESS: LEDGER_EXCESS} | COURSE


def side_title(side: str) -> str:
    """One of `SIDES` in words."""
    return side.replace("_", "-")


STUDIED = ("efficiency", "power_loss", "input_power", "output_power", "mesh_frequency")
"""Those of `TRAIN` that a study stores; a study has set-points in columns of their own."""
CLIPPED = "viscous_friction_clipped"
"""Column of a study's table, after a prefix of `SIDES`."""
EXCESS = "ledger_excess"
"""Column of a study's table, see `ledger_check`."""
LEDGER_EXCESS = Quantity(
    "Residual of the energy ledger",
    description="residual of the energy ledger/allowed residual; above 1, losses are uncertain",
)
SPEED_SHARE = "speed_share"
"""Column of a study's table, see `studies.turning`."""
SPEED = Quantity(
    "Speed/operating point",
    description="mean mesh frequency/that of the operating point; NaN where the gears are to stand "
    "still, or run up",
)
COURSE = {
    "unsettled": Quantity(
        "Time to settle", "s", "time until creeping gears no longer depend on their initial state"
    ),
    "reversals": Quantity(
        "Reversals", description="steps in which vibration stops gears, or slows them strongly"
    ),
    "both_flanks": Quantity(
        "Both flanks", description="steps in which both flanks of a tooth touch"
    ),
    "unrepeated_flank_events": Quantity(
        "Flank events",
        description="engagements and separations of flanks in a motion that does not become "
        "periodic",
    ),
}
"""Counters of `run.counters.Course`, from which the accuracy of a point is estimated."""
STUDY_RESULTS = _study()
"""Columns of the results of a study, in order."""
STUDIED_OF_AXES = ("displacement_peak", "bearing_force_peak")
"""Those of `BEARING` that a study stores, of planets the largest."""
ERROR_TURNS = "error_turns"
"""Column of a study's table, see `statics.error_turns`."""
AXES_RESULTS = {
    "load_sharing_factor": Quantity(
        "Load sharing factor",
        description="K_gamma, largest mean load share of a planet over a mesh cycle",
    ),
    ERROR_TURNS: Quantity(
        "Turns of errors",
        description="turns against the planets of the error that turns least; NaN if none turns",
    ),
} | {
    f"{body}_{name}": _titled(BEARING[name], "planets" if body == "planet" else body)
    for body in COMPONENTS
    for name in STUDIED_OF_AXES
}
"""Further columns of a study in which axes move."""
