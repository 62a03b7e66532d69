"""A lifecycle node whose parameters accept numbers as typed, and whose refusals are one line."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from typing import Any

from lifecycle_msgs.srv import GetAvailableTransitions, GetState
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.lifecycle import LifecycleNode
from rclpy.parameter import Parameter
from rclpy.service import Service

from .parameters import brief, check_settable, coerce, fixed_at, is_fixed, is_number

_OF_ROS = ("use_sim_time", "start_type_description_service")
_QOS = "qos_overrides."  # of topics; ROS declares them


class ParameterNode(LifecycleNode):
    """
    Node `name` in `namespace`; `overrides` are start values, as from the command line.

    Raises `ValueError` if `use_sim_time` is not a bool.
    """

    def __init__(self, name: str, namespace: str, overrides: Mapping[str, Any]) -> None:
        super().__init__(
            name,
            namespace=namespace,
            parameter_overrides=[Parameter(key, value=value) for key, value in overrides.items()],
            automatically_declare_parameters_from_overrides=True,
        )
        self.given: dict[str, Any] = self._take_overrides()
        """Start values of parameters that are not declared yet, by name."""
        self.add_pre_set_parameters_callback(self._coerced)

    @property
    def state(self) -> str:
        """Label of the lifecycle state, such as `inactive`."""
        get: Any = self.service_of(GetState).callback
        return str(get(GetState.Request(), GetState.Response()).current_state.label)

    def transitions(self) -> dict[int, str]:
        """Return the labels of the transitions of the present state, by their ids."""
        kind, state = GetAvailableTransitions, self.state
        get: Any = self.service_of(kind).callback
        answer = get(kind.Request(), kind.Response())
        return {
            offered.transition.id: offered.transition.label
            for offered in answer.available_transitions
            if offered.start_state.label == state
        }

    def service_of(self, kind: type) -> Service:
        """Return the first service of type `kind`, for example one that rclpy has created."""
        return next(service for service in self.services if service.srv_type is kind)

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """As rclpy's; `read_only` if it cannot be set in the present lifecycle state."""
        descriptor = copy(super().describe_parameter(name))
        descriptor.read_only = descriptor.read_only or is_fixed(descriptor, self.state)
        return descriptor

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """
        As rclpy's, but a refusal names the parameter and the reason.

        A fixed parameter may be set to its present value, so that a file from `ros2 param dump`
        can be loaded.
        """
        try:
            changing = [p for p in parameter_list if not fixed_at(self, p)]
            for parameter in changing:
                check_settable(self, parameter)
            if parameter_list and not changing:
                return SetParametersResult(successful=True)
            result = super().set_parameters_atomically(changing)
            if result.successful:
                result.reason = self.remark(changing)
            return result
        except ValueError as refusal:
            return SetParametersResult(successful=False, reason=str(refusal))

    def remark(self, parameters: list[Parameter]) -> str:
        """Return what a client should know of `parameters` that were set, or an empty text."""
        return ""

    def _take_overrides(self) -> dict[str, Any]:
        """Undeclare the parameters that rclpy declared from overrides; the node declares them."""
        declared: dict[str, Any] = dict(self.get_parameters_by_prefix(""))  # of `Parameter`
        given = {
            name: parameter.value
            for name, parameter in declared.items()
            if name not in _OF_ROS and not name.startswith(_QOS)
        }
        for name in given:
            self.undeclare_parameter(name)
        simulated = self.get_parameter("use_sim_time").value
        if not isinstance(simulated, bool):
            raise ValueError(f"use_sim_time = {brief(simulated)}: must be of type BOOL")
        return given

    def _coerced(self, parameters: list[Parameter]) -> list[Parameter]:
        # The only callback of this kind: with several, rclpy 7.1 duplicates parameters.
        numbers = {p.name for p in parameters if is_number(self, p.name)}
        return coerce(parameters, numbers)
