"""Hears a twin and keeps when each message was sent and when it came."""

from __future__ import annotations

import time
from collections.abc import Mapping
from typing import Any

import numpy as np
from diagnostic_msgs.msg import DiagnosticArray
from planetary_twin_msgs.msg import GearboxState
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.parameter import Parameter

from ..client import Client
from ..reports import real_time_figures
from ..running.children import Child, RunError
from .figures import Quantiles

_START = 120.0  # [s] longest wait for the first message: a first run compiles
_ANSWER = 2.0  # [s]
_KNOB = "lambda_ratio"  # is what the scene prescribes, so a state shows it at once


class Meter(Client):
    """Beside a simulation in `namespace`, whose process `simulation` is."""

    def __init__(self, namespace: str, simulation: Child) -> None:
        super().__init__("meter", namespace, simulation.check)
        self.figures: Mapping[str, str] = {}
        self.shown = float("nan")  # lambda ratio of the newest state
        self._shown_at = 0  # [ns] when it came first
        self._sent: list[int] = []
        self._numbers: list[int] = []
        self._came: list[int] = []
        self.node.create_subscription(GearboxState, "gearbox_state", self._hear, 1000)
        self.node.create_subscription(DiagnosticArray, "/diagnostics", self._diagnose, 10)
        self._set = self.node.create_client(
            SetParametersAtomically, "simulation/set_parameters_atomically"
        )

    def begin(self) -> None:
        """Wait for the twin, and forget what came until now."""
        if not self.wait(lambda: self._sent and self._set.service_is_ready(), _START):
            raise RunError("simulation: publishes nothing")
        self.forget()

    def forget(self) -> None:
        """Begin a new measurement."""
        for kept in (self._sent, self._came, self._numbers):
            kept.clear()

    @property
    def heard(self) -> int:
        """Messages since the measurement began."""
        return len(self._numbers)

    @property
    def lost(self) -> int:
        """Messages missing between the first and the last heard."""
        numbers = list(self._numbers)
        return numbers[-1] - numbers[0] + 1 - len(numbers) if numbers else 0

    def jitter(self, period: float) -> tuple[Quantiles, Quantiles]:
        """
        Return the deviation [s] of the time between two messages from `period` [s].

        First as the publisher stamped them in sending, then as they came.
        """
        sent, came = (
            Quantiles.of(np.abs(np.diff(times) * 1e-9 - period))
            for times in (list(self._sent), list(self._came))
        )
        return sent, came

    def latency(self, value: float) -> tuple[float, float]:
        """Set the knob; time [s] until the answer, and until a message has come that shows it."""
        request = SetParametersAtomically.Request(
            parameters=[Parameter(_KNOB, value=value).to_parameter_msg()]
        )
        begin = time.monotonic_ns()
        future = self._set.call_async(request)
        answered: list[int] = []
        future.add_done_callback(lambda _: answered.append(time.monotonic_ns()))
        if not self.wait(lambda: answered and abs(self.shown - value) < 1e-6, _ANSWER):
            raise RunError(f"simulation: does not show {_KNOB} = {value:g} within {_ANSWER:g} s")
        return (answered[0] - begin) * 1e-9, (self._shown_at - begin) * 1e-9

    def _hear(self, state: GearboxState, info: dict[str, Any]) -> None:
        now = time.monotonic_ns()
        self._came.append(now)
        self._sent.append(info["source_timestamp"])
        self._numbers.append(state.sequence)
        ratio = float(state.sun_planet_lambda_ratio[0])
        if abs(ratio - self.shown) > 1e-6 or ratio != ratio:
            self._shown_at = now
        self.shown = ratio

    def _diagnose(self, message: DiagnosticArray) -> None:
        self.figures = real_time_figures(message, self.namespace) or self.figures
