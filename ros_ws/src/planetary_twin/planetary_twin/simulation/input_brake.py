"""Brakes the input shaft of a twin for which commands are missing."""

from __future__ import annotations

from planetary_twin_py import Twin
from planetary_twin_py.run.commands import SIDES
from planetary_twin_py.scene.drive import Ports

_QUANTITIES = {"torque": ("torque",), "motion": ("speed", "position")}  # by port


def for_ports(values: dict[str, float], ports: Ports) -> dict[str, float]:
    """Return those `values` that are given at `ports`."""
    sides = zip(SIDES, ports, strict=True)
    names = [
        f"{side}_{quantity}" for side, port in sides for quantity in _QUANTITIES.get(port, ())
    ]
    return {name: values[name] for name in names if name in values}


class InputBrake:
    """
    Brakes the input shaft by its port: the engine of the twin brings the shaft to rest.

    It does so from any speed, and needs no command for it that could be refused.
    """

    def __init__(self) -> None:
        self._before: tuple[Twin, Ports] | None = None  # braked twin, its ports without the brake

    def ports(self, twin: Twin) -> Ports:
        """Return the ports of `twin` without the brake."""
        braked, ports = self._before or (None, None)
        return ports if ports is not None and braked is twin else twin.ports

    def begin(self, twin: Twin) -> None:
        """Brake `twin`."""
        self._before = twin, self.ports(twin)
        twin.set_ports(*twin.ports.braked)

    def release(self, twin: Twin) -> None:
        """Restore the ports from before the brake."""
        twin.set_ports(*self.ports(twin))
        self._before = None
