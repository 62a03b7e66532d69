"""Temperatures of a run, which its losses heat on a grid of simulated time.

Heat is taken from the energy ledger at multiples of a period, which is at most a tenth of the
shortest time constant of the parts. So temperatures do not depend on the windows of the run. The
oil keeps its viscosity until a temperature has moved by the dead band of the scene.
"""

from __future__ import annotations

from collections.abc import Iterator
from types import ModuleType

import numpy as np

from .._core import HEAT, Integrator, Model, Network, Oil, WindowEnd
from ..model.clock import TICKS, instant_of_ticks
from ..model.library import record_in
from ..model.network import build_network
from ..scene import OperatingPoint, Scene
from ..scene.thermal import COLDEST, HOTTEST, NODES, SOURCES, Temperatures

PERIODS = tuple(TICKS // n for n in (10, 20, 50, 100, 200, 500, 1000))
"""Between two instants at which heat is taken [ticks of the clock]: the longest that resolves the
shortest time constant, or else the shortest."""
RESOLVED = 0.1  # of the shortest time constant


class Warming:
    """Temperatures of a run.

    Args:
        core: build of the core on which the scene runs.
        scene: of the run, with the section `thermal`.
        oil: its constants at the temperature of the operating point.
    """

    def __init__(self, core: ModuleType, scene: Scene, oil: Oil) -> None:
        self._core = core
        self.network: Network = record_in(core, build_network(scene, oil))
        """Record of the core."""
        self.network.temperature = start_temperatures(scene)
        self.period = _period(self.network)
        """Time between two instants at which heat is taken [ticks]."""
        self._taken = 0  # [ticks] the last of them
        self._heat = np.zeros(len(SOURCES))  # [J] taken so far

    @property
    def temperatures(self) -> dict[str, float]:
        """Present temperatures by part, and that of the ambient air [K]."""
        values = self.network.temperature.tolist()
        return dict(zip(NODES, values, strict=True)) | {"ambient": self.network.ambient}

    @property
    def oil(self) -> float:
        """Temperature of the oil [K]."""
        return float(self.network.temperature[0])

    @property
    def next(self) -> int:
        """Instant at which heat is taken next [ticks]."""
        return (self._taken // self.period + 1) * self.period

    def instants(self, until: int) -> Iterator[int]:
        """Instants before `until` [ticks] at which heat is taken."""
        yield from range(self.next, until, self.period)

    def put_viscosity(self, oil: Oil) -> None:
        """Give `oil` the viscosities at the present temperatures."""
        self._core.warm_oil(self.network, oil)

    def warm(self, model: Model, integrator: Integrator, ticks: int) -> bool:
        """Take the heat up to `ticks` from the ledger of a run with vibration.

        Args:
            model: of the run; gets other viscosities if a temperature has moved by the dead band.
            integrator: of the run; its last step then ends there.
            ticks: the instant, not before the last one.

        Returns:
            Whether the viscosities have changed.

        Raises:
            ArithmeticError: a part leaves the range of temperatures, or no step is possible.
        """
        duration = self._passed(ticks)
        if duration == 0.0:
            return False
        now = instant_of_ticks(ticks)
        renewed = self._core.warm_up(model, integrator, self.network, now, duration)
        self._note(duration)
        return bool(renewed)

    def take(self, heat: np.ndarray, ticks: int) -> bool:
        """Take heat up to `ticks`.

        Args:
            heat: of each source since the last instant [J], (sources,).
            ticks: the instant, not before the last one.

        Returns:
            Whether a temperature has moved by the dead band, so that other viscosities are due.

        Raises:
            ArithmeticError: a part leaves the range of temperatures.
        """
        duration = self._passed(ticks)
        if duration == 0.0:
            return False
        self._core.advance_network(self.network, heat, duration)
        self._note(duration)
        return bool(self._core.has_moved(self.network))

    def surround(self, point: OperatingPoint) -> None:
        """Continue in the ambient air of an operating point."""
        self.network.ambient = point.ambient_temperature

    def add_heat(self, end: WindowEnd) -> None:
        """Let `end`, with the heat that is not taken yet, have all heat since the start [J]."""
        end.ledger[HEAT:] += self._heat

    def _passed(self, ticks: int) -> float:
        """Time [s] from the last instant to `ticks`, which becomes the last one."""
        passed, self._taken = ticks - self._taken, ticks
        return passed / TICKS

    def _note(self, duration: float) -> None:
        """Add up the heat of the last step, and check the temperatures."""
        self._heat = self._heat + self.network.power * duration
        values = self.network.temperature
        outside = (values < COLDEST) | (values > HOTTEST)
        if outside.any():
            node = int(outside.argmax())
            raise ArithmeticError(
                f"{NODES[node]}: {values[node]:.4g} K leaves the range {COLDEST:g} to "
                f"{HOTTEST:g} K of the oil's laws; `planetary-twin temperature` shows the steady "
                "temperatures"
            )


def mean_heat(begin: WindowEnd, end: WindowEnd, duration: float) -> dict[str, float]:
    """Mean heat by source between two ends, see `Warming.add_heat`.

    Args:
        begin: at the start.
        end: `duration` [s] later.
        duration: time between them [s].

    Returns:
        The heat [W].
    """
    heat = (end.ledger[HEAT:] - begin.ledger[HEAT:]) / duration
    return dict(zip(SOURCES, heat.tolist(), strict=True))


def start_temperatures(scene: Scene) -> np.ndarray:
    """Temperatures of the parts at the start of a run [K], (nodes,).

    Args:
        scene: the scene, with the section `thermal`.

    Raises:
        ValueError: the start is steady, which `run.steady_start` replaces by temperatures.
    """
    assert scene.thermal is not None
    start = scene.thermal.start
    if isinstance(start, Temperatures):
        return np.array([getattr(start, node) for node in NODES])
    if start == "steady":
        raise ValueError("thermal.start = 'steady': must be replaced by `with_start(scene)`")
    return np.full(len(NODES), scene.operating_point.ambient_temperature)


def _period(network: Network) -> int:
    """Time between two instants at which heat is taken [ticks]."""
    conductance = np.array(network.conductance)
    fastest = float((conductance.sum(axis=1) / network.capacity).max())
    resolved = RESOLVED / fastest * TICKS
    return next((period for period in PERIODS if period <= resolved), PERIODS[-1])
