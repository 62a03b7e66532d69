"""A user's program: subscribes to topics and calls services with plain rclpy."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import rclpy
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterType, ParameterValue
from rcl_interfaces.srv import GetParameters, SetParameters, SetParametersAtomically
from rclpy.client import Client
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import parameter_value_to_python
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.signals import SignalHandlerOptions
from std_srvs.srv import SetBool

TWIN = "/planetary_twin"
LATCHED = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)

_GOALS = {
    "configure": "inactive",
    "activate": "active",
    "deactivate": "inactive",
    "cleanup": "unconfigured",
}
LONG = 120.0  # [s] for a message or an answer on a busy machine
TIMEOUT = 10.0  # [s] for an answer
ATTEMPTS = 6
TRANSITION = 30.0  # [s] for configuring a node on a busy machine


class Peer:
    """Polls with a deadline instead of sleeping."""

    def __init__(self) -> None:
        self.context = rclpy.Context()
        rclpy.init(context=self.context, signal_handler_options=SignalHandlerOptions.NO)
        self.node = rclpy.create_node("peer", context=self.context)
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)
        self._clients: dict[str, Client] = {}

    def close(self) -> None:
        self._executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()

    def until(self, ready: Callable[[], Any], seconds: float = LONG) -> Any:
        """The first true value of `ready`; fails the test after `seconds`."""
        deadline = time.monotonic() + seconds
        while not (value := ready()):
            assert time.monotonic() < deadline, "nothing came in time"
            self._executor.spin_once(timeout_sec=0.02)
        return value

    def listen(self, kind: type, topic: str, qos: QoSProfile | int = 1000) -> list[Any]:
        """A list to which the messages of `topic` are appended."""
        received: list[Any] = []
        self.node.create_subscription(kind, topic, received.append, qos)
        return received

    def call(self, kind: type, service: str, request: Any, timeout: float = TIMEOUT) -> Any:
        """
        The response of a service.

        A response is lost if the server has not discovered a new client yet. The call is then
        repeated after `timeout` [s], which must be longer than the response takes if a repeated
        request matters.
        """
        if service not in self._clients:
            self._clients[service] = self.node.create_client(kind, service)
        client = self._clients[service]
        self.until(client.service_is_ready)
        for _ in range(ATTEMPTS):
            future = client.call_async(request)
            deadline = time.monotonic() + timeout
            while not future.done() and time.monotonic() < deadline:
                self._executor.spin_once(timeout_sec=0.02)
            if future.done():
                return future.result()
            client.remove_pending_request(future)
        raise AssertionError(f"{service}: no answer")

    def set(self, node: str, *, atomically: bool = False, **values: Any) -> Any:
        """Set parameters, each value in the type `ros2 param set` would give it."""
        parameters = [ParameterMsg(name=name, value=_typed(v)) for name, v in values.items()]
        if atomically:
            request = SetParametersAtomically.Request(parameters=parameters)
            service = f"{node}/set_parameters_atomically"
            return self.call(SetParametersAtomically, service, request).result
        request = SetParameters.Request(parameters=parameters)
        return self.call(SetParameters, f"{node}/set_parameters", request).results[0]

    def change_state(self, node: str, transition: str) -> None:
        """Make a lifecycle node execute a transition."""
        request = ChangeState.Request(transition=Transition(label=transition))

        def there() -> bool:
            answer = self.call(ChangeState, f"{node}/change_state", request, TRANSITION)
            return answer.success or self.state(node) == _GOALS[transition]  # the response was lost

        self.until(there)

    def state(self, node: str) -> str:
        """The state of a lifecycle node."""
        answer = self.call(GetState, f"{node}/get_state", GetState.Request())
        return str(answer.current_state.label)

    def pause(self, node: str, paused: bool = True) -> str:
        """Pause or resume a node; returns its answer."""
        answer = self.call(SetBool, f"{node}/pause", SetBool.Request(data=paused))
        assert answer.success, answer.message
        return str(answer.message)

    def parameters(self, node: str, *names: str) -> list[Any]:
        """Values of parameters."""
        request = GetParameters.Request(names=names)
        answer = self.call(GetParameters, f"{node}/get_parameters", request)
        return [parameter_value_to_python(value) for value in answer.values]

    def get(self, node: str, name: str) -> float:
        """A parameter that must be a DOUBLE."""
        (value,) = self.parameters(node, name)
        assert isinstance(value, float)
        return value


def seconds(stamp: Any) -> float:
    """A stamp in seconds."""
    return float(stamp.sec + 1e-9 * stamp.nanosec)


@contextmanager
def connected() -> Iterator[Peer]:
    """A participant of the domain that the environment names."""
    peer = Peer()
    try:
        yield peer
    finally:
        peer.close()


def _typed(value: Any) -> ParameterValue:
    if isinstance(value, bool):
        return ParameterValue(type=ParameterType.PARAMETER_BOOL, bool_value=value)
    if isinstance(value, int):
        return ParameterValue(type=ParameterType.PARAMETER_INTEGER, integer_value=value)
    if isinstance(value, float):
        return ParameterValue(type=ParameterType.PARAMETER_DOUBLE, double_value=value)
    return ParameterValue(type=ParameterType.PARAMETER_STRING, string_value=value)
