"""A lifecycle node whose parameters take numbers as users type them, and refuse in one line."""

from __future__ import annotations

from collections.abc import Mapping
from copy import copy
from typing import Any

from lifecycle_msgs.srv import GetAvailableTransitions, GetState
from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.lifecycle import LifecycleNode
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile
from rclpy.service import Service

from .parameters import brief, check_settable, coerce, fixed_at, is_fixed, is_number

_OF_ROS = ("use_sim_time", "start_type_description_service")
_QOS = "qos_overrides."  # of topics, which ROS declares where it finds them
_MOST = 200  # parameters in a request: more than there are, but little work
_REQUESTS = QoSProfile(depth=100)


class ParameterNode(LifecycleNode):
    """
    Node in `namespace`; `overrides` are parameters as from the command line.

    Raises `ValueError` where `use_sim_time` is no bool.
    """

    def __init__(self, name: str, namespace: str, overrides: Mapping[str, Any]) -> None:
        super().__init__(
            name,
            namespace=namespace,
            parameter_overrides=[Parameter(key, value=value) for key, value in overrides.items()],
            automatically_declare_parameters_from_overrides=True,
        )
        self.given: dict[str, Any] = self._take_overrides()
        """Start values that no declaration has taken yet, by name."""
        self.service_of(SetParameters).callback = self._set_each
        self.service_of(SetParametersAtomically).callback = self._set_all
        self.add_pre_set_parameters_callback(self._coerced)

    @property
    def state(self) -> str:
        """Label of the lifecycle state, such as `inactive`."""
        get = self.service_of(GetState)
        return str(get.callback(GetState.Request(), GetState.Response()).current_state.label)

    def transitions(self) -> dict[int, str]:
        """Return labels of the transitions of the present state, by their numbers."""
        kind, state = GetAvailableTransitions, self.state
        answer = self.service_of(kind).callback(kind.Request(), kind.Response())
        return {
            offered.transition.id: offered.transition.label
            for offered in answer.available_transitions
            if offered.start_state.label == state
        }

    def service_of(self, kind: type) -> Service:
        """Return the first service of a type, such as one that rclpy has created."""
        return next(service for service in self.services if service.srv_type is kind)

    def create_service(self, *given: Any, **options: Any) -> Service:
        """As rclpy's, with room for few requests: who floods waits, and fills no memory."""
        return super().create_service(*given, **options | {"qos_profile": _REQUESTS})

    def describe_parameter(self, name: str) -> ParameterDescriptor:
        """As rclpy's; `read_only` where it cannot be set in the present lifecycle state."""
        descriptor = copy(super().describe_parameter(name))
        descriptor.read_only = descriptor.read_only or is_fixed(descriptor, self.state)
        return descriptor

    def set_parameters_atomically(self, parameter_list: list[Parameter]) -> SetParametersResult:
        """
        As rclpy's, with a refusal that names the parameter and the reason.

        What is fixed may be set to what it is: a file that `ros2 param dump` wrote loads.
        """
        try:
            changing = [p for p in parameter_list if not fixed_at(self, p)]
            for parameter in changing:
                check_settable(self, parameter)
            if parameter_list and not changing:
                return SetParametersResult(successful=True)
            return super().set_parameters_atomically(changing)
        except ValueError as refusal:
            return SetParametersResult(successful=False, reason=str(refusal))

    def _take_overrides(self) -> dict[str, Any]:
        """Undeclare what rclpy has declared of its own accord, so that the node declares it."""
        given = {
            name: parameter.value
            for name, parameter in self.get_parameters_by_prefix("").items()
            if name not in _OF_ROS and not name.startswith(_QOS)
        }
        for name in given:
            self.undeclare_parameter(name)
        simulated = self.get_parameter("use_sim_time").value
        if not isinstance(simulated, bool):
            raise ValueError(f"use_sim_time = {brief(simulated)}: must be of type BOOL")
        return given

    def _coerced(self, parameters: list[Parameter]) -> list[Parameter]:
        # The only callback of its kind: with several, rclpy 7.1 duplicates parameters.
        numbers = {p.name for p in parameters if is_number(self, p.name)}
        return coerce(parameters, numbers)

    # rclpy's own callbacks end the node at a value of no known type.

    def _set_each(
        self, request: SetParameters.Request, response: SetParameters.Response
    ) -> SetParameters.Response:
        messages = request.parameters
        if len(messages) > _MOST:
            response.results = [self._set(messages)] * len(messages)
        else:
            response.results = [self._set([message]) for message in messages]
        return response

    def _set_all(
        self, request: SetParametersAtomically.Request, response: SetParametersAtomically.Response
    ) -> SetParametersAtomically.Response:
        response.result = self._set(request.parameters)
        return response

    def _set(self, messages: list[Any]) -> SetParametersResult:
        if len(messages) > _MOST:
            reason = f"{len(messages)} parameters: at most {_MOST} at once"
            return SetParametersResult(successful=False, reason=reason)
        try:
            parameters = [Parameter.from_parameter_msg(message) for message in messages]
        except ValueError as refusal:
            name = brief(messages[0].name) if len(messages) == 1 else "parameters"
            return SetParametersResult(successful=False, reason=f"{name}: {refusal}")
        return self.set_parameters_atomically(parameters)
