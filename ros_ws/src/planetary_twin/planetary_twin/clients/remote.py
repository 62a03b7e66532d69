"""Reads and changes the parameters and the operating point of a running twin."""

from __future__ import annotations

import os
from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

from planetary_twin_msgs.srv import SetOperatingPoint
from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    ListParameters,
    SetParametersAtomically,
)
from rclpy.parameter import parameter_value_to_python

from planetary_twin_py import TUNABLES
from planetary_twin_py.scene.live import FAULTS, unit_of_live
from planetary_twin_py.scene.names import did_you_mean
from planetary_twin_py.units.conversion import to_si

from .client import Client
from .loopback import stay_on_this_machine

NODE = "simulation"
_TRIALS = 3
# Parameters that ROS declares.
_OF_ROS = ("qos_overrides.", "use_sim_time", "start_type_description_service")


class Setting(NamedTuple):
    """A parameter of the twin."""

    name: str
    value: Any
    fixed: bool
    description: str
    limits: str


def _unknown(refusal: str, name: str, known: Collection[str]) -> str:
    """Add the most similar name to a refusal, or else all known names."""
    return refusal + (did_you_mean(name, known) or f"; there are {', '.join(known)}")


class Remote(Client):
    """
    A client of the simulation in `namespace`.

    Methods raise `ConnectionError` if there is no simulation, or no response, and `ValueError` if
    it refuses.
    """

    def __init__(self, namespace: str) -> None:
        stay_on_this_machine()
        super().__init__("remote", namespace)

    def settings(self) -> list[Setting]:
        """Return all parameters of the twin, first those that may change now, sorted by name."""
        found = self._described([n for n in self._names() if not n.startswith(_OF_ROS)])
        return sorted(found, key=lambda setting: (setting.fixed, setting.name))

    def setting(self, name: str) -> Setting:
        """Return the parameter `name`."""
        found = {setting.name: setting for setting in self.settings()}
        if name not in found:
            raise ValueError(_unknown(f"{name}: no such parameter", name, found))
        return found[name]

    def set(self, name: str, typed: str) -> str:
        """
        Set the parameter `name` to the text `typed`, which may have a unit.

        Returns a remark: whether the parameter has no effect in the scene.
        """
        names = self._names()
        if name not in names:
            raise ValueError(_unknown(f"{name}: no such parameter", name, names))
        request = SetParametersAtomically.Request(
            parameters=[ParameterMessage(name=name, value=_message(in_si(name, typed)))]
        )
        answer = self._call(SetParametersAtomically, "set_parameters_atomically", request)
        if not answer.result.successful:
            raise ValueError(answer.result.reason)
        return str(answer.result.reason)

    def operate(self, typed: Mapping[str, str], ramp: float = 0.0) -> tuple[float, str]:
        """
        Change several quantities at one simulated instant.

        `typed` are values by name, as text. With a `ramp` [s], its end reaches them. Returns the
        instant [s], and a remark on quantities without effect in the scene.
        """
        for name in typed:
            if name in TUNABLES:
                continue
            names = self._names()
            if name.startswith(FAULTS) and name in names:
                continue
            if name in names:
                raise ValueError(
                    f"{name}: is not in the operating point; use planetary-twin param set "
                    f"{name} VALUE"
                )
            raise ValueError(_unknown(f"{name}: no such quantity", name, TUNABLES))
        values = [in_si(name, value) for name, value in typed.items()]
        request = SetOperatingPoint.Request(names=list(typed), values=values, ramp=ramp)
        answer = self._call(SetOperatingPoint, "set_operating_point", request)
        if not answer.success:
            raise ValueError(answer.message)
        return float(answer.simulated_time), str(answer.message)

    def _names(self) -> list[str]:
        listed = self._call(ListParameters, "list_parameters", ListParameters.Request())
        return sorted(listed.result.names)

    def _described(self, names: list[str]) -> list[Setting]:
        got = self._call(GetParameters, "get_parameters", GetParameters.Request(names=names))
        described = self._call(
            DescribeParameters, "describe_parameters", DescribeParameters.Request(names=names)
        )
        return [
            Setting(
                name,
                parameter_value_to_python(value),
                descriptor.read_only,
                descriptor.description,
                "".join(f"{r.from_value:g} to {r.to_value:g}" for r in
                        descriptor.floating_point_range),
            )
            for name, value, descriptor in zip(
                names, got.values, described.descriptors, strict=True
            )
        ]  # fmt: skip

    def _remedy(self) -> str:
        """Return the namespaces of other twins, or how to start one."""
        nodes = self.node.get_node_names_and_namespaces()
        if elsewhere := sorted({space for name, space in nodes if name == NODE}):
            return f"there is one in {', '.join(elsewhere)}: choose with --namespace"
        return "start one with `planetary-twin run`"

    def _call(self, kind: type, service: str, request: Any) -> Any:
        service = f"{NODE}/{service}"
        for _ in range(_TRIALS):
            if (answer := self.call(kind, service, request)) is not None:
                return answer
        if self.serves(kind, service):
            raise ConnectionError(f"{self.namespace}/{service}: no answer")
        domain = os.environ.get("ROS_DOMAIN_ID", "0")
        raise ConnectionError(
            f"no twin in {self.namespace} on ROS_DOMAIN_ID = {domain}: {self._remedy()}"
        )


def in_si(name: str, typed: str) -> Any:
    """
    Return the value of the text `typed` for the parameter `name`.

    It is a number in SI if the parameter is a quantity of the operating point, else the text.
    Raises `ValueError` if it is not a number or its unit is wrong.
    """
    try:
        unit = unit_of_live(name)
        return typed if unit is None else to_si(typed, unit)
    except ValueError as refusal:
        raise ValueError(f"{name} = {typed!r}: {refusal}") from None


def _message(value: Any) -> ParameterValue:
    """Return the message of a number or a text; the node converts texts."""
    if isinstance(value, float):
        return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
    return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)
