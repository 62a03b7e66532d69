"""Passes changes of the operating point to the live twin: parameters, and a service."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future

from planetary_twin_msgs.srv import SetOperatingPoint
from rclpy.parameter import Parameter

import planetary_twin_py as pt

from ..base.clock import set_stamp
from ..base.parameters import brief
from ..base.services import answer, executed
from .live.ramps import LONGEST_RAMP
from .parameters import TOLERANCE, changing
from .running import RunningSimulation


class OperatingPointControl:
    """
    Passes parameters of `node` that change to its live twin.

    The service `~/set_operating_point` sets several of them at one instant, or in a ramp.
    """

    def __init__(self, node: RunningSimulation) -> None:
        self._node = node
        self._submitted: Future[float] | None = None
        self._ramp = 0.0  # [s] duration of the ramp for the parameters being set
        node.add_post_set_parameters_callback(self._submit)
        node.create_service(SetOperatingPoint, "~/set_operating_point", self._set_operating_point)

    def _submit(self, parameters: list[Parameter]) -> None:
        live = self._node.live
        if live is None:
            return
        if any(p.name == TOLERANCE.name for p in parameters):
            self._node.renew_quality()
        values = changing(parameters)
        if not values:
            return
        before = self._submitted
        if self._ramp > 0.0:
            self._submitted = live.ramp(values, self._ramp)
        else:
            self._submitted = live.submit(values)
        if self._submitted is not before:  # otherwise merged with the change before
            self._submitted.add_done_callback(self._report_refusal)

    def _report_refusal(self, submitted: Future[float]) -> None:
        """Warn if the twin refuses parameters that are within their ranges."""
        refusal = submitted.exception()
        if refusal is not None and self._node.live is not None:
            self._node.get_logger().warning(f"the twin refuses its parameters: {refusal}")

    def _set_operating_point(
        self, request: SetOperatingPoint.Request, response: SetOperatingPoint.Response
    ) -> SetOperatingPoint.Response:
        def change() -> str:
            instant, remark = self._change(request.names, request.values, request.ramp)
            response.simulated_time = instant
            set_stamp(response.stamp, self._node.stamp(instant))
            return remark

        return answer(response, change)

    def _change(self, names: list[str], values: list[float], ramp: float) -> tuple[float, str]:
        """
        Set parameters; return the instant [s] from which they apply, and a remark.

        They are quantities of the operating point, and severities of faults. The remark names
        those that have no effect in the scene.
        """
        _check(names, values, ramp, (*pt.TUNABLES, *self._node.severities))
        if self._node.live is None:
            raise ValueError("the simulation is not active")
        parameters = [
            Parameter(name, Parameter.Type.DOUBLE, value)
            for name, value in zip(names, values, strict=True)
        ]
        self._ramp = ramp
        try:
            result = self._node.set_parameters_atomically(parameters)
        finally:
            self._ramp = 0.0
        if not result.successful or self._submitted is None:
            raise ValueError(result.reason)
        instant = executed(self._submitted, self._node.longest_wait)
        return instant, str(result.reason)


def _check(names: list[str], values: list[float], ramp: float, known: Sequence[str]) -> None:
    """Raise `ValueError` for a request that cannot be executed; quantities `known` may change."""
    if not 0.0 <= ramp <= LONGEST_RAMP:
        raise ValueError(f"ramp = {ramp:g} s: must be within 0 and {LONGEST_RAMP:g}")
    if len(names) != len(values) or not names:
        raise ValueError(
            f"{len(names)} names for {len(values)} values: must be equal, and at least 1"
        )
    for name in names:
        if name not in known:
            raise ValueError(f"{brief(name)}: no such quantity; there are {', '.join(known)}")
        if ramp > 0.0 and name not in pt.TUNABLES:
            raise ValueError(f"{name}: cannot follow a ramp; set it at once, or give it a growth")
        if list(names).count(name) > 1:
            raise ValueError(f"{name}: named twice")
