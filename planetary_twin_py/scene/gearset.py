"""The gearset: teeth, dimensions, inertia and planet positions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Literal, Self

from pydantic import Field, ValidationInfo, model_validator

from ..gearset.clearance import Size, check_clearance
from ..gearset.gear_set import GearSet, Sizes, build_gear_set
from ..gearset.geometry import pitch_radius
from ..gearset.interference import check_fit
from ..gearset.involute import DEDENDUM, TIP_ROUNDING
from ..gearset.kinematics import Teeth
from ..gearset.mount import Mount, mount
from ..gearset.normal_plane import base_helix, transverse_sizes
from ..gearset.phasing import assembled, check_assembly
from ..gearset.shift import PerGear
from ..tooth.fillet import largest_rounding
from ..tooth.undercut import check_undercut
from .quantity import Section, quantity

# Context of a validation that leaves out whether the fields fit together.
FIELDS_ALONE = "fields alone"

IN_RADIANS = "; an angle without a unit is in rad"

# Names of module and pressure angle in the transverse and in the normal plane.
_PLANES = ("module", "pressure_angle"), ("normal_module", "normal_pressure_angle")

Member = Literal["sun", "ring", "carrier"]
Held = Literal["sun", "ring", "carrier", "none"]


class ToothNumbers(Section):
    """Tooth numbers of the three kinds of gear."""

    sun: int = Field(ge=5, le=1000, description="teeth of the sun")
    planet: int = Field(ge=5, le=1000, description="teeth of a planet")
    ring: int = Field(ge=15, le=3000, description="teeth of the ring")


class ProfileShift(Section):
    """Profile shift coefficients, with the signs of ISO 21771.

    A positive coefficient makes the tooth of any gear thicker on its reference circle. It moves the
    teeth of sun and planets outwards, and those of the ring inwards. Sources that count the ring's
    shift outwards have the opposite sign there.
    """

    sun: float = quantity("", "profile shift of the sun in modules", 0.0, ge=-1.5, le=2.0)
    planet: float = quantity("", "profile shift of a planet in modules", 0.0, ge=-1.5, le=2.0)
    ring: float = quantity(
        "", "profile shift of the ring in modules, positive inwards", 0.0, ge=-2.0, le=1.5
    )


class TipDiameters(Section):
    """Tip diameters; default: by addendum and profile shift.

    By default a tip is lowered where it would leave less clearance to the mating root than the
    basic rack (tip alteration of ISO 21771).
    """

    sun: float | None = quantity("m", "tip diameter of the sun", None, gt=0.0, le=100.0)
    planet: float | None = quantity("m", "tip diameter of a planet", None, gt=0.0, le=100.0)
    ring: float | None = quantity("m", "tip diameter of the ring", None, gt=0.0, le=100.0)


class EquivalentMasses(Section):
    """J/r^2 with the reference radius m z/2; for the carrier with that of the planet centres."""

    sun: float = quantity("kg", "J/r^2 of the sun", gt=0.0, le=1e6)
    planet: float = quantity("kg", "J/r^2 of one planet", gt=0.0, le=1e6)
    ring: float = quantity("kg", "J/r^2 of the ring", gt=0.0, le=1e6)
    carrier: float = quantity("kg", "J/r^2 of the carrier without planets", gt=0.0, le=1e6)


class Inertias(Section):
    """Moments of inertia about the own axes, in place of `equivalent_mass`."""

    sun: float = quantity("kg m^2", "moment of inertia of the sun", gt=0.0, le=1e8)
    planet: float = quantity("kg m^2", "moment of inertia of one planet", gt=0.0, le=1e8)
    ring: float = quantity("kg m^2", "moment of inertia of the ring", gt=0.0, le=1e8)
    carrier: float = quantity(
        "kg m^2", "moment of inertia of the carrier without planets", gt=0.0, le=1e8
    )


class Gearset(Section):
    """Geometry and inertia of a simple planetary gearset of involute gears.

    Module and pressure angle on the reference circles are given in one plane: `normal_module` and
    `normal_pressure_angle` in the normal plane, as drawings of helical gears have them, or `module`
    and `pressure_angle` in the transverse plane. Addendum, dedendum, fillet radius and profile
    shifts are in the module that is given. With a helix angle, contact lines move along the face;
    axial forces act on bodies with dynamics: spatial. Profile shift and centre distance determine
    the working pressure angle of both meshes. Moments of inertia are given as `equivalent_mass` or
    as `inertia`.
    """

    teeth: ToothNumbers = Field(description="tooth numbers")
    module: float | None = quantity("m", "module, in the transverse plane", None, gt=0.0, le=0.2)
    pressure_angle: float | None = quantity(
        "rad", "pressure angle, in the transverse plane", None, ge=0.15, le=0.6
    )
    normal_module: float | None = quantity(
        "m", "module in the normal plane, in place of module", None, gt=0.0, le=0.2
    )
    normal_pressure_angle: float | None = quantity(
        "rad", "pressure angle in the normal plane, with normal_module", None, ge=0.15, le=0.6
    )
    helix_angle: float = quantity(
        "rad",
        "helix angle on the pitch circle, positive for a right-hand sun",
        0.0,
        ge=-0.8,
        le=0.8,
    )
    addendum: float = quantity(
        "", "addendum of the basic rack in modules, those of the plane that is given",
        1.0, gt=0.0, le=1.5,
    )  # fmt: skip
    dedendum: float = quantity(
        "", "dedendum of the basic rack in the same modules", DEDENDUM, ge=0.5, le=2.0
    )
    fillet_radius: float | None = quantity(
        "", "tip radius of the basic rack, which cuts the root fillet, in the same modules; "
        "default: 0.38, or the largest with room", None, ge=0.05, le=0.8,
    )  # fmt: skip
    profile_shift: ProfileShift = Field(ProfileShift(), description="profile shift coefficients")
    centre_distance: float | None = quantity(
        "m",
        "distance of the planet centres from the axis; default: sun meshes have no backlash",
        None,
        gt=0.0,
        le=100.0,
    )
    tip_diameter: TipDiameters = Field(TipDiameters(), description="tip diameters")
    face_width: float = quantity("m", "face width", gt=0.0, le=5.0)
    planet_angles: tuple[float, ...] = quantity(
        "rad",
        "angular positions of the planets on the carrier; rounded to 0.01 deg, they are the "
        "nearest ones at which teeth mesh",
        min_length=2,
        max_length=7,
    )
    held: Held = Field("carrier", description="fixed member; none: a differential with two inputs")
    equivalent_mass: EquivalentMasses | None = Field(
        None, description="moments of inertia divided by r^2"
    )
    inertia: Inertias | None = Field(
        None, description="moments of inertia, in place of equivalent_mass"
    )
    planet_mass: float = quantity("kg", "mass of one planet", gt=0.0, le=1e6)

    @property
    def planets(self) -> int:
        """Number of planets."""
        return len(self.planet_angles)

    @property
    def base_helix(self) -> float:
        """Helix angle on the base circle [rad], positive for a right-hand sun."""
        return base_helix(self.transverse.pressure_angle, self.helix_angle)

    @property
    def tooth_numbers(self) -> Teeth:
        """Tooth numbers as a tuple."""
        return Teeth(self.teeth.sun, self.teeth.planet, self.teeth.ring)

    @property
    def transverse(self) -> Sizes:
        """Module, pressure angle and coefficients of the transverse plane."""
        shift, tip = self.profile_shift, self.tip_diameter
        given = Sizes(
            self.tooth_numbers,
            *self.module_and_angle,
            self.addendum,
            PerGear(shift.sun, shift.planet, shift.ring),
            self.centre_distance,
            (tip.sun, tip.planet, tip.ring),
            self.dedendum,
            self.fillet_radius or TIP_ROUNDING,
        )
        return given if self.module else transverse_sizes(given, self.helix_angle)

    @property
    def module_and_angle(self) -> tuple[float, float]:
        """Module [m] and pressure angle [rad] in the plane in which the scene gives them."""
        names = next(plane for plane in _PLANES if getattr(self, plane[0]) is not None)
        module, angle = (getattr(self, name) for name in names)
        return module, angle

    @property
    def geometry(self) -> GearSet:
        """The gears and their meshes at the centre distance."""
        return build_gear_set(self.transverse)

    @property
    def mounted(self) -> Mount:
        """Direction of tooth 0 of all gears in the assembly position."""
        lead = self.geometry.meshes[0].coast_lead
        return mount(self.tooth_numbers, self.planet_angles, lead)

    @property
    def twist(self) -> PerGear:
        """Turn of the sections of helical gears per way along the axis [rad/m]; 0 of spur gears."""
        teeth = self.tooth_numbers
        rise = math.tan(self.helix_angle) * 2.0 / self.transverse.module
        return PerGear(rise / teeth.sun, -rise / teeth.planet, -rise / teeth.ring)

    @property
    def rim_masses(self) -> EquivalentMasses:
        """J/r^2 [kg], given or from the moments of inertia."""
        if self.inertia is None:
            assert self.equivalent_mass is not None
            return self.equivalent_mass
        radii = {
            name: pitch_radius(teeth, self.transverse.module)
            for name, teeth in self.tooth_numbers._asdict().items()
        } | {"carrier": self.geometry.centre_distance}
        return EquivalentMasses(
            **{name: getattr(self.inertia, name) / r**2 for name, r in radii.items()}
        )

    @model_validator(mode="after")
    def _can_be_put_together(self, info: ValidationInfo) -> Self:
        if info.context == FIELDS_ALONE:
            return self
        errors = [*self._planes()] or [*self._fillet(), *self._teeth(), *self._planets()]
        if errors := [*self._inertias(), *errors]:
            raise ValueError("\n".join(line.removeprefix("gearset.") for line in errors))
        exact = assembled(self.tooth_numbers, self.planet_angles)
        object.__setattr__(self, "planet_angles", exact)  # before anyone has the frozen section
        return self

    def _planes(self) -> Iterator[str]:
        """Errors of a module and a pressure angle that are not given once, in one plane."""
        transverse, normal = (
            [n for n in plane if getattr(self, n) is not None] for plane in _PLANES
        )
        if transverse and normal:
            either = ", or ".join(" and ".join(plane) for plane in _PLANES)
            yield f"{', '.join(transverse + normal)}: given together: give {either}"
            return
        names = _PLANES[1] if normal else _PLANES[0]
        yield from (f"{name}: missing" for name in names if getattr(self, name) is None)

    def _fillet(self) -> Iterator[str]:
        """Error of a fillet radius for which the basic rack has no room."""
        if self.fillet_radius is not None:
            largest = largest_rounding(self.dedendum, self.module_and_angle[1])
            if self.fillet_radius > largest:
                yield (
                    f"fillet_radius = {self.fillet_radius:g}: must be at most {largest:.4g}, with "
                    f"which one arc rounds the tip of a rack with dedendum = {self.dedendum:g}"
                )

    def _inertias(self) -> Iterator[str]:
        """Error of moments of inertia that are missing or given twice."""
        if (self.equivalent_mass is None) == (self.inertia is None):
            which = "missing" if self.inertia is None else "given twice"
            yield f"equivalent_mass, inertia: {which}: give one of the two"

    def _teeth(self) -> Iterator[str]:
        """Errors of teeth that do not fit into each other."""
        sun, planet, ring = self.tooth_numbers
        shifted = self.profile_shift != ProfileShift() or self.centre_distance is not None
        if ring != sun + 2 * planet and not shifted:
            yield (
                f"teeth = {sun}/{planet}/{ring}: standard gears are coaxial only if "
                f"ring = sun + 2 planet = {sun + 2 * planet}; other gears require "
                "gearset.profile_shift or gearset.centre_distance"
            )
            return
        if self._standard:
            return
        try:
            gears = self.geometry
        except ValueError as error:
            yield str(error)
            return
        errors = list(check_fit(gears))
        yield from errors
        if not errors:
            for mesh in gears.meshes:
                yield from check_undercut(mesh)

    def _planets(self) -> Iterator[str]:
        """Errors of planets that touch each other or cannot be assembled."""
        teeth, angles = self.tooth_numbers, self.planet_angles
        try:
            size = self._size()
        except ValueError:  # listed by `_teeth`
            return
        errors = list(_error(lambda: check_clearance(size, angles)))
        if not errors:
            addendum = self.transverse.addendum
            errors = list(_error(lambda: check_assembly(teeth, angles, addendum, size)))
        turns = max(map(abs, angles)) > 2.0 * math.pi  # as degrees without their unit are
        yield from (f"{line}{IN_RADIANS if turns else ''}" for line in errors)

    @property
    def _standard(self) -> bool:
        """Whether the teeth have no profile shift and the usual tips."""
        return (
            self.profile_shift == ProfileShift()
            and self.tip_diameter == TipDiameters()
            and self.centre_distance is None
            and self.fillet_radius is None
            and self.addendum < self.dedendum == DEDENDUM
        )

    def _size(self) -> Size:
        sizes = self.transverse
        if self._standard:
            return Size(self.tooth_numbers, sizes.module, sizes.addendum)
        gears = self.geometry
        return Size(
            self.tooth_numbers,
            sizes.module,
            sizes.addendum,
            gears.centre_distance,
            2.0 * gears.planet.tip_radius,
        )


def _error(check: Callable[[], None]) -> Iterator[str]:
    """Message of a check that raises `ValueError`."""
    try:
        check()
    except ValueError as error:
        yield str(error)
