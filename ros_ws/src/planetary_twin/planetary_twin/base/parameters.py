"""Declares parameters, and reads numbers in the types that users and tools send."""

from __future__ import annotations

import reprlib
from array import array
from collections.abc import Callable, Container, Iterator
from dataclasses import field, fields
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo
from rcl_interfaces.msg import (
    FloatingPointRange,
    ParameterDescriptor,
    ParameterType,
    ParameterValue,
)
from rclpy.node import Node
from rclpy.parameter import Parameter

from planetary_twin_py import TUNABLES, Tunable
from planetary_twin_py.scene.drive import Causality
from planetary_twin_py.scene.quantity import unit_of, within
from planetary_twin_py.units.conversion import customary

if TYPE_CHECKING:
    from _typeshed import DataclassInstance

AT_START = "fixed while the node runs: set it at start, -p {name}:=VALUE"
_UNCONFIGURED = (
    "fixed while the node is configured: set it before, or at start, -p {name}:=VALUE "
    "(planetary-twin run: --param {name}=VALUE)"
)
AT_ONCE = "a finite number, also written 1 or 2e-7; applies at once"
_BETWEEN = "takes effect between two published intervals"
_GEOMETRY = "geometry is fixed: choose another scene, -p scene:=SCENE"
_STATE = "a state of this scene (thermal): set ambient_temperature, or thermal.start of a new run"
_MOST_CHARACTERS = 13  # of a refused value that is shown as it is
Settings = TypeVar("Settings", bound="DataclassInstance")
Contents = TypeVar("Contents")
_BRIEF = reprlib.Repr()
_BRIEF.maxstring = _BRIEF.maxother = 60


def brief(value: Any) -> str:
    """Return any `value` as text for a refusal: one line, shortened if it is long."""
    return _BRIEF.repr(_listed(value))


def _listed(value: Any) -> Any:
    return list(value) if isinstance(value, array) else value


class Declaring(Protocol):
    """Node that declares parameters; `given` are start values of undeclared parameters."""

    given: dict[str, Any]

    def declare_parameter(
        self, name: str, value: Any, descriptor: ParameterDescriptor, ignore_override: bool
    ) -> Parameter:
        """As rclpy's."""

    def set_descriptor(
        self, name: str, descriptor: ParameterDescriptor, alternative_value: ParameterValue
    ) -> ParameterValue:
        """As rclpy's."""


def changes(descriptor: ParameterDescriptor) -> str:
    """Return when a parameter may be set: `at start`, `unconfigured`, `live` or `with scene`."""
    if descriptor.additional_constraints == _UNCONFIGURED.format(name=descriptor.name):
        return "unconfigured"
    if descriptor.additional_constraints in (_GEOMETRY, _STATE):
        return "with scene"
    return "at start" if descriptor.read_only else "live"


def is_fixed(descriptor: ParameterDescriptor, state: str) -> bool:
    """Return whether a parameter cannot be set in the lifecycle state `state` of its node."""
    return changes(descriptor) not in ("live", state)


def fixed_at(node: Node, given: Parameter) -> bool:
    """Return whether `given` is the present value of a fixed parameter, sent in any type."""
    if not (node.has_parameter(given.name) and node.describe_parameter(given.name).read_only):
        return False
    value = node.get_parameter(given.name).value
    if isinstance(value, float):
        return number(given.name, given.value) == value
    return str(_listed(given.value)) == str(_listed(value))


def check_settable(node: Node, parameter: Parameter) -> None:
    """
    Raise `ValueError` if `parameter` does not exist, is fixed, or has a wrong type or value.

    Numbers may have other types, see `coerce`.
    """
    if not node.has_parameter(parameter.name):
        raise ValueError(f"{brief(parameter.name)}: no such parameter")
    refused = f"{parameter.name} = {brief(parameter.value)}"
    descriptor = node.describe_parameter(parameter.name)
    if descriptor.read_only:
        reason = descriptor.additional_constraints or "fixed while the node runs"
        raise ValueError(f"{refused}: {reason}")
    wanted = Parameter.Type(descriptor.type)
    if wanted not in (Parameter.Type.DOUBLE, parameter.type_):
        raise ValueError(f"{refused}: must be of type {wanted.name}")
    if descriptor.floating_point_range:
        _check_within(descriptor, parameter.name, number(parameter.name, parameter.value))


def is_number(node: Node, name: str) -> bool:
    """Return whether `node` has a parameter `name` of type DOUBLE."""
    double = ParameterType.PARAMETER_DOUBLE
    return node.has_parameter(name) and node.describe_parameter(name).type == double


def _check_within(descriptor: ParameterDescriptor, name: str, value: float) -> None:
    """
    Raise `ValueError` if `value` is out of range; the message of rclpy lacks the unit.

    The description of a setting says which values have a meaning of their own.
    """
    for limits in descriptor.floating_point_range:
        low, high = limits.from_value, limits.to_value
        if low <= value <= high:
            continue
        if name in TUNABLES:
            unit = TUNABLES[name].unit
            refused = f"{name} = {_refused(value, low, high)} {unit}".rstrip()
            raise ValueError(
                f"{refused}: {within(low, high, unit)}{_in_customary(low, high, unit)}"
            )
        raise ValueError(f"{name} = {value!r}: {within(low, high, '')} ({descriptor.description})")


def _refused(value: float, low: float, high: float) -> str:
    """Return `value`; one of many digits, as from a converted unit, rounded if still refused."""
    rounded = f"{value:.6g}"
    short = len(repr(value)) <= _MOST_CHARACTERS
    return repr(value) if short or low <= float(rounded) <= high else rounded


def _in_customary(low: float, high: float, unit: str) -> str:
    """Return a range in customary units, for users who think in them."""
    ends = [customary(end, unit, 6) for end in (low, high)]
    return f" ({' to '.join(ends)})" if all(ends) else ""


def declare(
    node: Declaring,
    name: str,
    default: Any,
    description: str,
    limits: tuple[float, float] | None = None,
    when: str = _UNCONFIGURED,
) -> Any:
    """
    Declare a parameter and return its value.

    A float is within `limits`, and may also be given as 1 or 1e3. `when` says when it may be set:
    `AT_START`, until the node is configured, or `AT_ONCE`.
    """
    descriptor = ParameterDescriptor(
        description=description,
        read_only=when == AT_START,
        additional_constraints=when.format(name=name),
    )
    if limits:
        low, high = limits
        descriptor.floating_point_range = [FloatingPointRange(from_value=low, to_value=high)]
    kind = _declare_number if isinstance(default, float) else _declare
    return kind(node, name, default, descriptor)


def setting(
    default: Any,
    description: str,
    limits: tuple[float, float] | None = None,
    when: str = _UNCONFIGURED,
) -> Any:
    """Return a field of a dataclass of settings: a parameter, see `declare`."""
    # rclpy derives the type of a list from its first element, so the default has an empty text.
    return field(metadata={
        "default": default, "description": description, "limits": limits, "when": when,
    })  # fmt: skip


def declare_settings(node: Declaring, kind: type[Any]) -> None:
    """Declare a parameter for each field of the dataclass `kind`, which `setting` has made."""
    for each in fields(kind):
        declare(node, each.name, **each.metadata)


def settings_of(node: Node, kind: type[Settings]) -> Settings:
    """Return the present values of the parameters that `declare_settings` has declared."""
    return kind(**{each.name: node.get_parameter(each.name).value for each in fields(kind)})


def read_named(parameter: str, name: str, read: Callable[[Path], Contents]) -> Contents:
    """Read the file `name` of a `parameter`; raises `ValueError` if it cannot be read."""
    path = Path(name).expanduser()
    try:
        return read(path)
    except OSError as reason:
        raise ValueError(f"{parameter} = {str(path)!r}: {reason.strerror}") from None


def declare_tunable(node: Declaring, tunable: Tunable, default: float, topic: str) -> float:
    """
    Declare a quantity that may change while the twin runs and return its value at start.

    `topic` is the topic that publishes the instant of a change.
    """
    return float(
        declare(
            node,
            tunable.name,
            default,
            f"{tunable.description} [{tunable.unit or '-'}]",
            (tunable.minimum, tunable.maximum),
            f"a finite number, also written 1 or 2e-7; {_BETWEEN}; {topic} gives the instant",
        )
    )


def declare_oil_state(node: Declaring, oil: Tunable, default: float) -> None:
    """Declare the temperature of `oil` that is a state: fixed, without effect."""
    description = "of the scene, without effect: topic oil_temperature has the present value"
    limits = oil.minimum, oil.maximum
    declare(node, oil.name, default, f"{description} [{oil.unit}]", limits, _STATE)


def declare_port(node: Declaring, name: str, side: str, default: str) -> None:
    """Declare what acts on the shaft of `side`, which may change while the twin runs."""
    causalities = [each for each in get_args(Causality) if side == "input" or each != "brake"]
    description = f"what acts on the {side} shaft: {', '.join(causalities)}"
    when = f"{_BETWEEN}; operating_point gives the instant"
    declare(node, name, default, description, when=when)


def declare_geometry(node: Declaring, prefix: str, section: BaseModel) -> None:
    """
    Declare every field of a section of the scene as a read-only parameter below `prefix`.

    Raises `ValueError` if a start value differs from the scene's.
    """
    for name, info, value in _fields(prefix, section):
        unit = unit_of(info)
        descriptor = ParameterDescriptor(
            description=f"{info.description}" + ("" if unit is None else f" [{unit or '-'}]"),
            additional_constraints=_GEOMETRY,
        )
        declared = _declare_number if isinstance(value, float) else _declare
        given: Any = declared(node, name, value, descriptor)
        if (list(given) if isinstance(value, list) else given) != value:
            raise ValueError(f"{name} = {brief(given)}: {_GEOMETRY}")


def _fields(prefix: str, section: BaseModel) -> Iterator[tuple[str, FieldInfo, Any]]:
    """Yield dotted name, field and value of each leaf that has a value."""
    for key, info in type(section).model_fields.items():
        name, value = f"{prefix}.{key}", getattr(section, key)
        if isinstance(value, BaseModel):
            yield from _fields(name, value)
        elif value is not None:
            yield name, info, list(value) if isinstance(value, tuple) else value


def coerce(parameters: list[Parameter], numbers: Container[str]) -> list[Parameter]:
    """
    Return `parameters`, with those named in `numbers` as DOUBLE.

    `ros2 param set` sends `1` as INTEGER and `2e-7` as STRING, which strict typing refuses.
    Raises `ValueError` for a value that is not a number.
    """
    return [
        Parameter(p.name, Parameter.Type.DOUBLE, number(p.name, p.value))
        if p.name in numbers
        else p
        for p in parameters
    ]


def number(name: str, value: Any) -> float:
    """Return `value` as float; raises `ValueError` with the field `name` if it is not a number."""
    if isinstance(value, (int, float, str)) and not isinstance(value, bool):
        try:
            return float(value)
        except (ValueError, OverflowError):
            pass
    raise ValueError(f"{name} = {brief(value)}: must be a number")


def _declare(node: Declaring, name: str, default: Any, descriptor: ParameterDescriptor) -> Any:
    # A start value applies to the first declaration only; later ones belong to another scene.
    first = node.given.pop(name, None) is not None
    return node.declare_parameter(name, default, descriptor, ignore_override=not first).value


def _declare_number(
    node: Declaring, name: str, default: float, descriptor: ParameterDescriptor
) -> float:
    # A start value may have the type INTEGER or STRING, and a declaration checks its type at once:
    # declare the parameter with dynamic typing, then set the type with the number.
    given = _declare(node, name, default, ParameterDescriptor(dynamic_typing=True))
    descriptor.type = ParameterType.PARAMETER_DOUBLE
    value = Parameter(name, Parameter.Type.DOUBLE, number(name, given))
    _check_within(descriptor, name, value.value)
    return float(node.set_descriptor(name, descriptor, value.get_parameter_value()).double_value)
