"""The sections of a scene, each checked by itself."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

from pydantic import Field

from .drive import Drive
from .durability import Durability
from .errors import Errors
from .fault_rules import Faulted, errors_of_faults
from .faults import MOST_FAULTS, Fault
from .gearset import Gearset
from .losses import Losses
from .lubrication import Lubrication
from .mesh import Mesh
from .operating_point import TUNABLES, OperatingPoint, Tunable
from .quantity import Section, limit_of, quantity
from .sensors import MOST_SENSORS, AnySensor
from .sensors.rules import Surroundings
from .supports import Supports
from .thermal import Thermal

LIMITS = {  # fields of the drive that limit a quantity
    name: limit.removeprefix("drive.")
    for name, field in OperatingPoint.model_fields.items()
    if (limit := limit_of(field))
}


class SceneParts(Section):
    """A scene before the rules across its sections."""

    name: str = Field(description="name in recordings and pictures")
    description: str = Field("", description="description in words")
    dynamics: Literal[
        "torsional", "planar", "spatial", "quasi_static", "quasi_static_planar",
        "quasi_static_spatial", "auto",
    ] = Field(
        "torsional",
        description="torsional: bodies vibrate in rotation, their axes are held; planar: the axes "
        "also move in the plane, on the bearings of `supports`; spatial: they also move axially "
        "and tilt; quasi_static: the train turns rigidly on held axes, with loads in static "
        "equilibrium at every instant; quasi_static_planar and quasi_static_spatial: the same "
        "with axes that move; auto: the simplest of these, except quasi_static_spatial, whose "
        "errors are within `dynamics_error` at the operating point",
    )  # fmt: skip
    dynamics_error: float = quantity(
        "", "largest relative error of forces, DTE and loss, for dynamics: auto", 0.02,
        gt=0.0, le=1.0,
    )  # fmt: skip
    gearset: Gearset = Field(description="teeth, dimensions and inertia of the gears")
    mesh: Mesh = Field(description="stiffness, damping and backlash of the meshes")
    lubrication: Lubrication = Field(description="oil, surfaces and friction laws")
    drive: Drive = Field(description="motors, load and speed control")
    operating_point: OperatingPoint = Field(
        description="quantities that may change while the twin runs"
    )
    losses: Losses = Field(Losses(), description="losses outside the tooth contacts")
    supports: Supports | None = Field(
        None,
        description="masses and bearings, for dynamics: planar and spatial, static load sharing, "
        "and planar and spatial natural modes",
    )
    errors: Errors = Field(
        Errors(), description="deviations of gears and carrier, which make planets differ"
    )
    faults: tuple[Fault, ...] = Field(
        (), max_length=MOST_FAULTS, description="faulty teeth, pins and bearings"
    )
    thermal: Thermal | None = Field(
        None, description="temperatures as states; none: oil_temperature is given"
    )
    sensors: tuple[AnySensor, ...] = Field(
        (), max_length=MOST_SENSORS, description="sensors, each with a name of its own"
    )
    durability: Durability | None = Field(
        None, description="strength of gears and bearings, by which damage is counted, and wear"
    )

    def errors_of_faults(self, faults: Sequence[Fault]) -> Iterator[str]:
        """Errors of faults in place of those of this scene.

        Args:
            faults: faulty teeth, pins and bearings.

        Returns:
            A line for each fault that this scene cannot have.
        """
        faulted = Faulted(self.gearset, self.mesh.stiffness, self.dynamics, self.supports)
        yield from errors_of_faults(faults, faulted)

    @property
    def surroundings(self) -> Surroundings:
        """What its sensors need of it."""
        second = self.drive.second_input is not None
        return Surroundings(self.gearset.held, second, self.dynamics)

    @property
    def moving_axes(self) -> bool:
        """Whether the axes move in a simulation."""
        return self.dynamics.endswith(("planar", "spatial"))

    @property
    def tilting_axes(self) -> bool:
        """Whether the axes tilt and move along themselves in a simulation."""
        return self.dynamics.endswith("spatial")

    @property
    def quasi_static(self) -> bool:
        """Whether loads are in static equilibrium at every time of a simulation."""
        return self.dynamics.startswith("quasi_static")

    @property
    def tunables(self) -> dict[str, Tunable]:
        """Quantities that may change while this scene runs, with their ranges."""
        return {
            name: tunable.within(getattr(self.drive, LIMITS[name])) if name in LIMITS else tunable
            for name, tunable in TUNABLES.items()
        }
