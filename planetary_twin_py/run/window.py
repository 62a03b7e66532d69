"""Results of a twin over an interval of time: waveform and statistics."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .._core import MESH_STATISTICS
from ..durability.damage import Damage
from ..model.layout import LOAD_MACHINE, MOTOR, SECOND_MOTOR
from ..scene import OperatingPoint
from ..sensors.sensed import Readings
from ..text.object_repr import brief, brief_record
from .axes.motion import AxesMotion
from .counters import Course
from .energy import efficiency


@dataclass
class MeshSamples:
    """Every sample of every mesh, (samples, meshes) each, by the first names of `WAVEFORM`."""

    time: np.ndarray
    """Sample times [s], (samples,)."""
    dte: np.ndarray
    """Dynamic transmission error along the line of action [m]."""
    mesh_force: np.ndarray
    """Normal force, negative on the coast flanks [N]."""
    friction: np.ndarray
    """Magnitude of boundary plus viscous friction [N]."""


@dataclass(kw_only=True, repr=False)
class Waveform(MeshSamples):
    """Samples of a window; sample times are integer multiples of the sample period."""

    period: float
    """Sample period [s]."""

    def __repr__(self) -> str:
        """One line; arrays by their shapes."""
        return brief_record(self)


@dataclass(frozen=True)
class Window:
    """Results over one interval of simulated time.

    All means cover exactly the window. Windows do not shorten steps of the integrator, so the
    motion does not depend on them; powers and torques of the train are taken as constant within the
    step that contains the end of a window, so their integrals over consecutive windows are exact.
    """

    start: float
    """Start of the window [s]."""
    end: float
    """End of the window [s]."""
    tolerance: float
    """Relative local error tolerance of the integrator."""
    sample_rate: float
    """Sample rate of the waveform [Hz]."""
    repeated: bool
    """Whether the motion at the start was periodic, so that it was not computed again."""
    bodies: tuple[str, ...]
    """Names of the bodies, in the order of arrays over bodies."""
    meshes: tuple[str, ...]
    """Names of the meshes, in the order of arrays over meshes."""
    waveform: Waveform
    """Samples of the meshes."""
    mesh: dict[str, np.ndarray]
    """Statistics of the meshes by name, (meshes,) each, see `by_name`."""
    angle: np.ndarray
    """Absolute angles at the end, in [0, 2 pi) [rad], (bodies,)."""
    mean_speed: np.ndarray
    """Mean speed, positive counter-clockwise [rad/s], (bodies,)."""
    mesh_frequency: float
    """Mesh frequency at the mean speed [Hz]."""
    machine_speed: np.ndarray
    """Speeds of motor, load, and second motor of a differential [rad/s], (machines,)."""
    machine_torque: np.ndarray
    """Torques of the machines on their shafts [N m], (machines,)."""
    machine_power: np.ndarray
    """Powers from the machines into the train [W], (machines,)."""
    power_loss: float
    """Power loss of tooth friction, bearings, seals and churning [W]."""
    stored_power: float
    """Mean rate of increase of kinetic and elastic energy [W]."""
    stored_energy: float
    """Kinetic and elastic energy at the end [J]."""
    residual_power: float
    """Residual of the energy ledger, an error of the integration [W]."""
    course: Course
    """Counters from which the accuracy is estimated, see `accuracy`."""
    given: Mapping[str, float]
    """Commands at the ports from the start of the window on, by arguments of `Twin.advance`."""
    axes: AxesMotion | None
    """Motion of the axes and forces on their bearings; None where the axes are held."""
    members: tuple[int, ...]
    """Places in `bodies` of the members to which the machines are coupled, (machines,)."""
    sensors: Mapping[str, Readings]
    """Readings of the sensors that were completed in the window, by name. They are computed in
    blocks, and filters delay them, so they begin before the window does; a run that has just
    started has none until its filters are filled."""
    point: OperatingPoint
    """Operating point over the window; its `oil_temperature` is not that of oil that is a state."""
    severities: Mapping[str, float]
    """Severities of the faults at the end, by dotted name, `faults.0.depth` [SI]."""
    damage: Damage | None
    """Damage of the parts over the window; None if the scene has no section `durability`."""
    temperatures: Mapping[str, float]
    """Temperatures at the end [K]: oil, sun, planets, ring, housing, ambient; empty unless they are
    states (`thermal`)."""
    heat: Mapping[str, float]
    """Mean heat by source [W], whose sum is `power_loss`; empty unless temperatures are states."""

    @property
    def shaft_torque(self) -> np.ndarray:
        """Mean torque on the shaft of each body [N m], (bodies,); NaN without a shaft."""
        torque = np.full(len(self.bodies), math.nan)
        torque[list(self.members)] = self.machine_torque
        return torque

    @property
    def input_speed(self) -> float:
        """Speed of the motor [rad/s]."""
        return float(self.machine_speed[MOTOR])

    @property
    def input_torque(self) -> float:
        """Torque of the motor [N m]."""
        return float(self.machine_torque[MOTOR])

    @property
    def second_input_speed(self) -> float:
        """Speed of the second motor [rad/s]; NaN without one."""
        return float(self.machine_speed[SECOND_MOTOR]) if self._differential else math.nan

    @property
    def second_input_torque(self) -> float:
        """Torque of the second motor [N m]; NaN without one."""
        return float(self.machine_torque[SECOND_MOTOR]) if self._differential else math.nan

    @property
    def _differential(self) -> bool:
        return len(self.machine_speed) > SECOND_MOTOR

    @property
    def output_speed(self) -> float:
        """Speed of the load [rad/s]."""
        return float(self.machine_speed[LOAD_MACHINE])

    @property
    def output_torque(self) -> float:
        """Torque of the load on its shaft [N m]."""
        return float(self.machine_torque[LOAD_MACHINE])

    @property
    def input_power(self) -> float:
        """Power from the motors into the train [W]."""
        return float(self.machine_power[MOTOR] + self.machine_power[SECOND_MOTOR:].sum())

    @property
    def output_power(self) -> float:
        """Power from the train into the load [W]."""
        return -float(self.machine_power[LOAD_MACHINE])

    @property
    def efficiency(self) -> float:
        """1 - power_loss/power of the driving machines; NaN if no machine drives, as at standstill.

        A machine drives if its mean power over the window does: divide a window in which power
        changes direction. Power that is only stored does not count, see `Energy.driven`.
        """
        driving = float(np.maximum(self.machine_power, 0.0).sum())
        stored = self.stored_energy / (self.end - self.start)
        return efficiency(self.power_loss, driving, self.stored_power, stored)

    def __repr__(self) -> str:
        """One line."""
        samples, meshes = f"{len(self.waveform.time)} samples", f"{len(self.meshes)} meshes"
        return brief(self, f"{self.start:g} to {self.end:g} s", samples, meshes)


def by_name(rows: np.ndarray) -> dict[str, np.ndarray]:
    """Mean, rms and peak values of the meshes over an interval, by name.

    The integrator computes them independently of samples. The rms value is that of the deviation
    from the mean, the peak is the largest magnitude. Film thickness and lambda ratio are means over
    the time in contact, NaN without contact. `without_viscous` is the fraction of time in which
    teeth carry load without viscous friction.

    Args:
        rows: from the core, a row of all meshes for each of `MESH_STATISTICS`.

    Returns:
        Statistics in SI by name, (meshes,) each.
    """
    return {name: rows[row] for name, row in MESH_STATISTICS.items()}
