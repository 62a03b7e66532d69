"""A scene: everything that a run needs, and checks across its sections."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any, Literal, Self

from pydantic import Field, TypeAdapter, ValidationError, model_validator

from ..gearset.kinematics import MEMBERS
from .defect import explain
from .drive import Drive
from .durability import Durability
from .errors import PER_PLANET, Errors
from .fault_rules import Faulted, errors_of_faults
from .faults import MOST_FAULTS, Fault, Pin, severities, severity_tunables
from .gearset import FIELDS_ALONE, Gearset
from .live import live_values
from .losses import Losses
from .lubrication import Lubrication
from .mesh import Mesh, TipReliefs
from .names import no_such_field
from .oil_grade import without_other_oil
from .operating_point import TUNABLES, OperatingPoint, Tunable
from .paths import NoSuchPath, paths, with_value
from .quantity import SceneError, Section, limit_of, listed, quantity
from .sensors import MOST_SENSORS, AnySensor
from .sensors.rules import Surroundings, errors_of_sensors
from .support_rules import missing_stiffnesses, unsupported, unsupported_along
from .supports import Supports
from .thermal import Thermal, with_ambient_in_point
from .worn import WornFlanks

SPECIFIC_STIFFNESS = 2e10  # [Pa], of a mesh per face width (ISO 6336-1, 20 N/(mm um))
_LIMITS = {  # fields of the drive that limit a quantity
    name: limit.removeprefix("drive.")
    for name, field in OperatingPoint.model_fields.items()
    if (limit := limit_of(field))
}


class Scene(Section):
    """A gearset with its laws, its drive and its operating point."""

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

    @model_validator(mode="before")
    @classmethod
    def _ambient(cls, data: Any) -> Any:
        return with_ambient_in_point(data) if isinstance(data, dict) else data

    @model_validator(mode="after")
    def _parts_fit_together(self) -> Self:
        if errors := [*self._errors()]:
            raise ValueError("\n".join(errors))
        return self

    def _errors(self) -> Iterator[str]:
        """Errors of parts that do not fit together."""
        yield from self._machines()
        yield from self._ports()
        yield from self._limits()
        yield from self._faulty_teeth()
        yield from self._closed_backlash()
        yield from self._relief()
        yield from self._errors_of_planets()
        yield from self._moving_axes()
        yield from self._unfit_sensors()
        yield from self._heat_of_friction()

    def _machines(self) -> Iterator[str]:
        """Errors of the drive: a machine on the fixed member, or a wrong number of inputs."""
        held = self.gearset.held
        default = "" if "held" in self.gearset.model_fields_set else f" (default: {held})"
        for side in ("input", "second_input", "output"):
            machine = getattr(self.drive, side)
            if machine is not None and machine.member == held:
                yield (
                    f"drive.{side}.member = {held!r}: is fixed by gearset.held{default}, so "
                    f"drive.{side}.member must be {' or '.join(self._free_members())}"
                )
        if (self.drive.second_input is None) != (held != "none"):
            needed = "requires" if held == "none" else "does not allow"
            yield f"gearset.held = {held!r}: {needed} drive.second_input"
        if self.drive.second_input is None and self.operating_point.second_input_speed != 0.0:
            speed = self.operating_point.second_input_speed
            yield f"second_input_speed = {speed!r}: must be 0 without a second input"

    def _free_members(self) -> list[str]:
        """Members that are not fixed and have no machine."""
        machines = (self.drive.input, self.drive.second_input, self.drive.output)
        taken = {self.gearset.held, *(machine.member for machine in machines if machine)}
        return [member for member in MEMBERS if member not in taken]

    def _ports(self) -> Iterator[str]:
        """Errors of ports at which torque or motion is given."""
        second, ports = self.drive.second_input, self.drive.ports
        if second is not None and second.port != "machine":
            yield f"drive.second_input.port = {second.port!r}: must be machine"
        if second is not None and ports.given and ports.output == "machine":
            yield (
                f"drive.input.port = {ports.input!r}: requires drive.output.port = torque or "
                "motion in a differential (gearset.held = 'none')"
            )
        if ports.output == "brake":
            yield "drive.output.port = 'brake': only drive.input.port can be brake"
        for side, port in ports._asdict().items():
            if port != "machine" and self.quasi_static:
                yield f"drive.{side}.port = {port!r}: requires dynamics other than quasi-static"

    def _limits(self) -> Iterator[str]:
        """Errors of the operating point: values outside the limits of the drive."""
        for name, tunable in TUNABLES.items():
            value = getattr(self.operating_point, name)
            reach = getattr(self.drive, _LIMITS[name]) if name in _LIMITS else math.inf
            if abs(value) > reach or not tunable.minimum <= value <= tunable.maximum:
                why = f" (drive.{_LIMITS[name]})" if name in _LIMITS else ""
                yield f"{name} = {value!r}: {self.tunables[name].range}{why}"

    def _faulty_teeth(self) -> Iterator[str]:
        """Errors of the faults: missing teeth or planets, or a crack depth without geometry."""
        yield from self.errors_of_faults(self.faults)

    def errors_of_faults(self, faults: Sequence[Fault]) -> Iterator[str]:
        """Errors of faults in place of those of this scene.

        Args:
            faults: faulty teeth, pins and bearings.

        Returns:
            A line for each fault that this scene cannot have.
        """
        faulted = Faulted(self.gearset, self.mesh.stiffness, self.dynamics, self.supports)
        yield from errors_of_faults(faults, faulted)

    def _closed_backlash(self) -> Iterator[str]:
        """Error of a runout that presses both flanks of a tooth into their neighbours."""
        if self.moving_axes or self.dynamics == "auto":
            return  # there both flanks have their forces, or dynamics without them is refused later
        runout, angle = self.mesh.runout, self.gearset.transverse.pressure_angle
        backlash = self.operating_point.backlash
        half = self.mesh.flanks(backlash, angle)[0]
        sines = [math.sin(mesh.pressure_angle) for mesh in self.gearset.geometry.meshes]
        most = max(sine * a for sine, a in zip(sines, (runout.sun, runout.ring), strict=True))
        closed = max(sines) * runout.planet + most - half
        opened = self._least_deflection()
        if 2.0 * closed > 0.5 * opened:  # half of it may be lost to vibration
            least = 1.005 * (closed + half) / self.mesh.flanks(1.0, angle)[0]  # rounded upwards
            yield (
                f"backlash = {backlash!r}: must be at least {least:.3g} m, as mesh.runout closes "
                f"the backlash by {2.0 * closed:.3g} m more than there is, of which the load opens "
                f"{0.5 * opened:.3g} m: both flanks of a tooth would touch at once"
            )

    def _relief(self) -> Iterator[str]:
        """Errors of loaded entry, wear and relief: of helical teeth, or longer than the path."""
        if self.mesh.entry == "loaded" and self.gearset.helix_angle != 0.0:
            yield "mesh.entry = 'loaded': requires spur teeth, gearset.helix_angle = 0"
        if self.mesh.worn != WornFlanks() and self.gearset.helix_angle != 0.0:
            yield "mesh.worn: requires spur teeth, gearset.helix_angle = 0"
        if self.mesh.tip_relief == TipReliefs():
            return
        if self.gearset.helix_angle != 0.0:
            yield "mesh.tip_relief: requires spur teeth, gearset.helix_angle = 0"
        for mesh in self.gearset.geometry.meshes:
            longest = mesh.path.contact_ratio * mesh.base_pitch
            for name in mesh.names:
                relief = getattr(self.mesh.tip_relief, name)
                if relief is not None and relief.length > longest:
                    yield (
                        f"mesh.tip_relief.{name}.length = {relief.length:g}: must be at most "
                        f"{longest:.4g} m, the path of contact of {' and '.join(mesh.names)}"
                    )

    def _heat_of_friction(self) -> Iterator[str]:
        """Error of a friction torque that is not the heat of its mesh."""
        if self.thermal is not None and self.lubrication.friction_torque == "printed":
            yield (
                "lubrication.friction_torque = 'printed': must be sliding with thermal, because "
                "the printed torques do not dissipate the friction loss"
            )

    def _errors_of_planets(self) -> Iterator[str]:
        """Errors of lists that have no entry for each planet."""
        planets = self.gearset.planets
        for name in PER_PLANET:
            count = len(getattr(self.errors, name))
            if count not in (0, planets):
                yield f"errors.{name}: has {count} entries: must have {planets}, one a planet"
        for name, worn in self.mesh.worn:
            if worn is not None and len(worn.planets) not in (0, planets):
                yield (
                    f"mesh.worn.{name}.planets: has {len(worn.planets)} entries: must have "
                    f"{planets}, one a planet"
                )
        if self.errors.pin_stiffness and self.supports and self.supports.planet.rolling:
            yield (
                "errors.pin_stiffness: requires planets on linear bearings, without "
                "supports.planet.rolling"
            )
        if self.errors.of_axes and self.gearset.held == "none":
            yield "errors: ring_offset and carrier_offset require a fixed member (gearset.held)"

    def _moving_axes(self) -> Iterator[str]:
        """Errors of a scene whose axes move: what its dynamics lack or do not hold."""
        if not self.moving_axes:
            yield from self._rated_members()
            return
        held, supports = self.gearset.held, self.supports
        why = f"with dynamics = {self.dynamics!r}"
        if supports is None:
            yield f"supports: missing; {why} all masses and bearings are required"
        else:
            missing = [*missing_stiffnesses(supports)] if self.tilting_axes else []
            if missing:
                yield (
                    f"{', '.join(missing)}: missing; {why} every body requires an axial and a "
                    "tilting stiffness, 0 where it floats"
                )
            yield from unsupported(supports)
            if self.tilting_axes and self.gearset.helix_angle != 0.0:
                yield from unsupported_along(supports)
            for name in ("sun", "ring", "carrier"):
                torsion = getattr(supports, name).torsion
                if torsion != 0.0 and name != held:
                    yield f"supports.{name}.torsion = {torsion!r}: must be 0 {why}, as {name} turns"
        if self.lubrication.friction_torque == "printed":
            yield f"lubrication.friction_torque = 'printed': must be 'sliding' {why}"
        if self.mesh.backlash == "regulatory_factor":
            yield f"mesh.backlash = 'regulatory_factor': must be 'dead_zone' {why}"

    def _rated_members(self) -> Iterator[str]:
        """Errors of rated bearings whose loads are not known, because the axes are held."""
        for member in ("sun", "ring", "carrier"):
            if self.durability and getattr(self.durability.bearings, member) is not None:
                yield (
                    f"durability.bearings.{member}: must be left out with dynamics = "
                    f"{self.dynamics!r}, where its load is not known: use planar or spatial"
                )

    def _unfit_sensors(self) -> Iterator[str]:
        """Errors of sensors that need other dynamics or shafts, or do not fit each other."""
        yield from errors_of_sensors(self.sensors, self.surroundings)

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

    def _least_deflection(self) -> float:
        """Deflection [m] of the stiffer meshes under the least torque, all pairs in contact."""
        gearset, mesh, point = self.gearset, self.mesh, self.operating_point
        teeth = gearset.teeth
        # Torques of sun, ring and carrier are as these tooth numbers.
        driven = {"sun": teeth.sun, "ring": teeth.ring, "carrier": teeth.sun + teeth.ring}
        count = driven[self.drive.input.member]
        radius = (
            0.5 * gearset.transverse.module * count * math.cos(gearset.transverse.pressure_angle)
        )
        torque = max(abs(point.input_torque) - abs(point.torque_ripple), 0.0)
        force = torque / (gearset.planets * radius)
        given = mesh.sun_planet_stiffness, mesh.planet_ring_stiffness
        single = max(k or SPECIFIC_STIFFNESS * gearset.face_width for k in given)
        return force / (single * max(mesh.double_pair_ratio, 1.0))

    @property
    def tunables(self) -> dict[str, Tunable]:
        """Quantities that may change while this scene runs, with their ranges."""
        return {
            name: tunable.within(getattr(self.drive, _LIMITS[name])) if name in _LIMITS else tunable
            for name, tunable in TUNABLES.items()
        }

    @property
    def live_values(self) -> dict[str, Any]:
        """Values that may change while this scene runs, by the arguments of `Twin.set`."""
        return live_values(self.operating_point, self.drive.ports, self.severities)

    @property
    def severities(self) -> dict[str, float]:
        """Severities of the faults by dotted name, `faults.0.depth`."""
        return severities(self.faults)

    @property
    def severity_tunables(self) -> dict[str, Tunable]:
        """Descriptions of the severities with their ranges, by dotted name."""
        return severity_tunables(self.faults)

    @property
    def pins(self) -> Errors:
        """The errors of the scene, with the pins that its faults displace."""
        moved = dict[int, tuple[float, float]]()
        for fault in self.faults:
            if isinstance(fault, Pin):
                radial, tangential = moved.get(fault.planet, (0.0, 0.0))
                moved[fault.planet] = radial + fault.radial, tangential + fault.tangential
        return self.errors.with_pins(moved, self.gearset.planets)

    @property
    def field_names(self) -> Iterator[str]:
        """Names of all fields, as `replace` accepts them."""
        return (path.removeprefix("operating_point.") for path in paths(self.model_dump()))

    def replace(self, **changes: Any) -> Scene:
        """A copy with other values.

        Args:
            changes: values in SI, or texts with a unit, by name. Names are fields of the operating
                point (``backlash=3e-7``) or dotted paths into the scene, including optional
                sections (``**{"mesh.ramp": 0.0, "faults.0.tooth": 3}``).

        Returns:
            The changed scene.

        Raises:
            SceneError: a name is unknown, or a value is out of range.
        """
        data, errors = self.model_dump(), []
        prefix = "lubrication."
        oil = {name.removeprefix(prefix): new for name, new in changes.items()}
        data["lubrication"] = without_other_oil(data["lubrication"], oil)
        given: dict[tuple[str, ...], str] = {}
        for name, value in changes.items():
            path = path_of(name)
            if given.setdefault(path, name) != name:
                errors.append(f"{path[-1]}: given twice, as {given[path]} and as {name}")
            try:
                data = with_value(data, [Scene], path, value)
            except NoSuchPath as error:
                reason = f"{error}"
                errors.append(
                    f"{name}: {reason}" if reason else no_such_field(name, self.field_names)
                )
        if errors:
            raise SceneError(listed(errors))
        return validated(data)

    def point_with(self, point: OperatingPoint, changes: Mapping[str, float]) -> OperatingPoint:
        """An operating point of this scene with other values.

        As with `replace`, but only what an operating point can invalidate is validated, which is
        forty times as fast.

        Args:
            point: an operating point of this scene.
            changes: values in SI by the names of its fields.

        Returns:
            The changed operating point.

        Raises:
            SceneError: a name is unknown, or a value is out of range.
        """
        given = changes.get("oil_temperature", point.oil_temperature)
        if self.thermal is not None and given != point.oil_temperature:
            raise SceneError(
                "oil_temperature: is a state of this scene (thermal), so it cannot be set; "
                "change ambient_temperature, or thermal.start of a new run"
            )
        data = {**dict(point), **changes}
        try:
            found = OperatingPoint.model_validate(data)
        except ValidationError:
            return self.replace(**data).operating_point  # for the message
        if found != point:
            there = self.model_copy(update={"operating_point": found})
            if any(there._errors()):
                return self.replace(**data).operating_point  # for the message
        return found


def path_of(name: str) -> tuple[str, ...]:
    """Path of a dotted name in a scene; operating quantities need no section before them."""
    return ("operating_point", name) if name in OperatingPoint.model_fields else (*name.split("."),)


def validated(data: Any) -> Scene:
    """Validate a scene.

    Args:
        data: values of the fields, a mapping by section.

    Returns:
        The scene.

    Raises:
        SceneError: fields are invalid or do not fit together; all errors are listed.
    """
    try:
        return Scene.model_validate(data)
    except ValidationError as error:
        raise SceneError(explain(error, Scene, _across(data, error))) from None


def _across(data: Any, error: ValidationError) -> Iterator[str]:
    """Errors across sections in a scene with errors in sections, as far as they can be found."""
    if not isinstance(data, dict) or not all(defect["loc"] for defect in error.errors()):
        return  # then the scene itself was checked
    valid = Scene.model_construct(**dict(_valid_sections(data)))
    for check in (valid._machines, valid._limits, valid._faulty_teeth):
        try:
            yield from check()
        except (AttributeError, KeyError):  # of a section that is invalid
            continue


def _valid_sections(data: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """Sections whose own fields are valid."""
    for name, field in Scene.model_fields.items():
        if name in data:
            try:
                kind: Any = Annotated[field.annotation, field]
                adapter: TypeAdapter[Any] = TypeAdapter(kind)
                yield name, adapter.validate_python(data[name], context=FIELDS_ALONE)
            except ValidationError:
                continue
