"""A scene: everything that a run needs, and checks across its sections."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Self

from pydantic import TypeAdapter, ValidationError, model_validator

from .defect import explain
from .errors import Errors
from .faults import Pin
from .gearset import FIELDS_ALONE
from .live import live_values
from .names import no_such_field
from .oil_grade import without_other_oil
from .operating_point import OperatingPoint, Tunable
from .parts import SceneParts
from .paths import NoSuchPath, paths, with_value
from .quantity import SceneError, listed
from .scene_rules import errors_of_scene, faulty_teeth, limits, machines
from .severities import severities, severity_tunables
from .thermal import with_ambient_in_point


class Scene(SceneParts):
    """A gearset with its laws, its drive and its operating point."""

    @model_validator(mode="before")
    @classmethod
    def _ambient(cls, data: Any) -> Any:
        return with_ambient_in_point(data) if isinstance(data, dict) else data

    @model_validator(mode="after")
    def _parts_fit_together(self) -> Self:
        if errors := [*errors_of_scene(self)]:
            raise ValueError("\n".join(errors))
        return self

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
            if any(errors_of_scene(there)):
                return self.replace(**data).operating_point  # for the message
        return found


def path_of(name: str) -> tuple[str, ...]:
    """Path of a dotted name in a scene; operating quantities need no section before them."""
    return ("operating_point", name) if name in OperatingPoint.model_fields else (*name.split("."),)


def validated(data: Any) -> Scene:
    """Validate a scene.

    Args:
        data: values of the fields, a mapping by section.

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
    for check in (machines, limits, faulty_teeth):
        try:
            yield from check(valid)
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
