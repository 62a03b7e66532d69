"""Declares parameters, and reads numbers however a user or a tool has typed them."""

from __future__ import annotations

from collections.abc import Container
from typing import Any

from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, ParameterType
from rclpy.node import Node
from rclpy.parameter import Parameter

from planetary_twin_py import Tunable

from .pacing import AS_FAST_AS_IT_GOES, FASTEST, SLOWEST, check_rate_factor

_AT_START = "fixed while the node lives: set it at start, -p {name}:=VALUE"


def declare_fixed(node: Node, name: str, default: Any, description: str) -> Any:
    """Declare a read-only parameter and return its value; a float also takes 1 and 1e3."""
    descriptor = ParameterDescriptor(
        description=description,
        read_only=True,
        additional_constraints=_AT_START.format(name=name),
    )
    if isinstance(default, float):
        return _declare_number(node, name, default, descriptor)
    return node.declare_parameter(name, default, descriptor).value


def declare_bounded(
    node: Node, name: str, default: float, limits: tuple[float, float], description: str
) -> float:
    """Declare a read-only number within `limits` and return its value."""
    descriptor = ParameterDescriptor(
        description=description,
        read_only=True,
        additional_constraints=_AT_START.format(name=name),
        floating_point_range=[FloatingPointRange(from_value=limits[0], to_value=limits[1])],
    )
    return _declare_number(node, name, default, descriptor)


def declare_rate_factor(node: Node) -> float:
    """Declare simulated seconds per second and return the value; 0 is as fast as it goes.

    Raises `ValueError` for one between 0 and the slowest.
    """
    value = declare_bounded(
        node,
        "rate_factor",
        1.0,
        (AS_FAST_AS_IT_GOES, FASTEST),
        f"simulated seconds per second, {SLOWEST:g} to {FASTEST:g}; 0: as fast as it goes [-]",
    )
    check_rate_factor(value)
    return value


def declare_tunable(node: Node, tunable: Tunable, default: float, told_in: str) -> float:
    """Declare a quantity that may change while the twin runs and return its value at start.

    `told_in` is the topic that tells the instant of a change.
    """
    bounds = FloatingPointRange(from_value=tunable.minimum, to_value=tunable.maximum)
    descriptor = ParameterDescriptor(
        description=f"{tunable.description} [{tunable.unit or '-'}]",
        additional_constraints="a finite number, also written 1 or 2e-7; "
        f"takes effect between two published intervals, at the instant {told_in} tells",
        floating_point_range=[bounds],
    )
    return _declare_number(node, tunable.name, default, descriptor)


def coerce(parameters: list[Parameter], numbers: Container[str]) -> list[Parameter]:
    """The same parameters, those named in `numbers` as DOUBLE.

    `ros2 param set` sends `1` as INTEGER and `2e-7` as STRING, which strict typing refuses.
    Raises `ValueError` for a value that is no number.
    """
    return [
        Parameter(p.name, Parameter.Type.DOUBLE, number(p.name, p.value))
        if p.name in numbers
        else p
        for p in parameters
    ]


def number(name: str, value: Any) -> float:
    """`value` as float; raises `ValueError` naming the field where it is none."""
    if isinstance(value, (int, float, str)) and not isinstance(value, bool):
        try:
            return float(value)
        except (ValueError, OverflowError):
            pass
    raise ValueError(f"{name} = {value!r}: must be a number")


def _declare_number(
    node: Node, name: str, default: float, descriptor: ParameterDescriptor
) -> float:
    # A value given at start may be typed INTEGER or STRING and is checked against the declared
    # type at once: declare it open, then close it with the number it means.
    given = node.declare_parameter(name, default, ParameterDescriptor(dynamic_typing=True)).value
    descriptor.type = ParameterType.PARAMETER_DOUBLE
    value = Parameter(name, Parameter.Type.DOUBLE, number(name, given))
    return float(node.set_descriptor(name, descriptor, value.get_parameter_value()).double_value)
