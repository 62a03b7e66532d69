"""Subscribes to a twin and records when each message was sent and received."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin.base.diagnostics import real_time_figures
from planetary_twin.clients.client import Client
from planetary_twin.running.node_process import Child, RunError
from planetary_twin_msgs.msg import GearboxState
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter

from .figures import Quantiles

_START = 120.0  # [s] longest wait for the first message: a first run compiles
_ANSWER = 2.0  # [s]
_PARAMETER = "lambda_ratio"  # prescribed by the scene, so the next state contains it


class Meter(Client):
    """Measures the simulation in `namespace`, which runs in the process `simulation`."""

    def __init__(self, namespace: str, simulation: Child) -> None:
        super().__init__("meter", namespace, simulation.check)
        self.figures: Mapping[str, str] = {}
        self.shown = float("nan")  # lambda ratio of the newest state
        self._shown_at = 0  # [ns] when that value was first received
        self._sent: list[int] = []
        self._numbers: list[int] = []
        self._received: list[int] = []
        self.node.create_subscription(GearboxState, "gearbox_state", self._on_state, 1000)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._on_diagnostics, 10)
        self._set = self.node.create_client(
            SetParametersAtomically, "simulation/set_parameters_atomically"
        )

    def begin(self) -> None:
        """Wait for the twin, and discard the messages so far."""
        if not self.wait(lambda: self._sent and self._set.service_is_ready(), _START):
            raise RunError("simulation: publishes nothing")
        self.restart()

    def restart(self) -> None:
        """Start a new measurement."""
        for kept in (self._sent, self._received, self._numbers):
            kept.clear()

    @property
    def received(self) -> int:
        """Return the number of messages since the start of the measurement."""
        return len(self._numbers)

    @property
    def lost(self) -> int:
        """Return the number of messages missing between the first and the last received."""
        numbers = list(self._numbers)
        return numbers[-1] - numbers[0] + 1 - len(numbers) if numbers else 0

    def jitter(self, period: float) -> tuple[Quantiles, Quantiles]:
        """
        Return the deviation [s] of the time between two messages from `period` [s].

        The first result is by the publisher's stamps, the second by the subscriber's clock.
        """
        sent, came = (
            Quantiles.of(np.abs(np.diff(times) * 1e-9 - period))
            for times in (list(self._sent), list(self._received))
        )
        return sent, came

    def latency(self, value: float) -> tuple[float, float]:
        """Set the parameter to `value`; returns the times [s] to the response and the message."""
        request = SetParametersAtomically.Request(
            parameters=[Parameter(_PARAMETER, value=value).to_parameter_msg()]
        )
        begin = time.monotonic_ns()
        future = self._set.call_async(request)
        answered: list[int] = []
        future.add_done_callback(lambda _: answered.append(time.monotonic_ns()))
        if not self.wait(lambda: answered and abs(self.shown - value) < 1e-6, _ANSWER):
            raise RunError(
                f"simulation: does not publish {_PARAMETER} = {value:g} within {_ANSWER:g} s"
            )
        return (answered[0] - begin) * 1e-9, (self._shown_at - begin) * 1e-9

    def _on_state(self, state: GearboxState, info: dict[str, Any]) -> None:
        now = time.monotonic_ns()
        self._received.append(now)
        self._sent.append(info["source_timestamp"])
        self._numbers.append(state.sequence)
        ratio = float(state.sun_planet_lambda_ratio[0])
        if abs(ratio - self.shown) > 1e-6 or ratio != ratio:
            self._shown_at = now
        self.shown = ratio

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        self.figures = real_time_figures(message, self.namespace) or self.figures
