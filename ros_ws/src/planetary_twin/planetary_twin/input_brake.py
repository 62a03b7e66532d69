"""Brakes the input shaft of a twin for which commands are missing."""

from __future__ import annotations

import math

from planetary_twin_py import Twin
from planetary_twin_py.recording.ros2.given import SIDES
from planetary_twin_py.scene.drive import Causality, Ports

_QUANTITIES = {"machine": (), "torque": ("torque",), "motion": ("speed", "position")}  # by port


def for_ports(values: dict[str, float], ports: Ports) -> dict[str, float]:
    """Return those `values` that are given at `ports`."""
    sides = zip(SIDES, ports, strict=True)
    names = [f"{side}_{quantity}" for side, port in sides for quantity in _QUANTITIES[port]]
    return {name: values[name] for name in names if name in values}


class InputBrake:
    """Brings the input shaft to rest at the slew rate of the drive, and holds it."""

    def __init__(self) -> None:
        self._before: tuple[Twin, Ports] | None = None  # braked twin, its ports without the brake

    def ports(self, twin: Twin) -> Ports:
        """Return the ports of `twin` without the brake."""
        braked, ports = self._before or (None, None)
        return ports if ports is not None and braked is twin else twin.ports

    def slow(self, twin: Twin, interval: float) -> dict[str, float]:
        """Return the speed that the input shaft has in the next `interval` [s]."""
        before = self.ports(twin)
        twin.set_ports("motion", _braked(before.output))
        self._before = twin, before
        speed = twin.port_states.input_speed
        less = twin.scene.drive.speed_control.slew_rate * interval
        slower = math.copysign(max(abs(speed) - less, 0.0), speed)
        return for_ports({"input_speed": slower, "output_torque": 0.0}, twin.ports)

    def release(self, twin: Twin) -> None:
        """Restore the ports from before the brake."""
        twin.set_ports(*self.ports(twin))
        self._before = None


def _braked(port: Causality) -> Causality:
    """Return the port of the output while the input is braked: a torque, which is zero."""
    return "torque" if port == "motion" else port
