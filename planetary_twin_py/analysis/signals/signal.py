"""Signals to analyse: a quantity of a mesh, from a recording or from the samples of a run."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Self, TypeVar
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from ...recording.container.records import RecordingError
from ...recording.container.suffixes import is_table
from ...recording.runs.reader import Recording, read_recording
from ...recording.runs.steadiness import steady_span
from ...recording.runs.unwrapping import unwrap
from ...units.catalogue import WAVEFORM
from ..sampling.segments import full_rate, longest_segment, sample_rate
from ..spectra.band import Band
from ..spectra.envelope import envelope

Array = NDArray[np.float64]
T = TypeVar("T")
MEAN = 0.5  # of the rms speed; the mean of a run-up from standstill is 0.87 of it
QUANTITIES = {name: quantity.si for name, quantity in WAVEFORM.items()}


@dataclass(frozen=True)
class Signal:
    """Samples of a quantity of a mesh."""

    samples: Array
    """In SI, (n,)."""
    time: Array
    """[s], (n,), uniformly spaced in a signal returned by `within`."""
    angle: Array
    """Of the sun relative to the carrier [rad], (n,), continuous over turns; the mesh order for
    this angle is the number of teeth of the sun, whichever member is held."""
    scene_yaml: str | None
    """The scene, if it is known."""
    remarks: tuple[str, ...] = ()
    """Warnings about the samples."""
    error: float = 0.0
    """Of interpolated samples, over the height of a tone."""

    @property
    def sample_rate(self) -> float:
        """Sample rate [Hz] of uniformly spaced samples."""
        return sample_rate(self.time)

    @property
    def speed(self) -> float:
        """Mean speed of the sun relative to the carrier [rad/s]."""
        return float((self.angle[-1] - self.angle[0]) / (self.time[-1] - self.time[0]))

    @property
    def rms_speed(self) -> float:
        """Rms speed of the sun relative to the carrier [rad/s] of uniformly spaced samples."""
        return float(np.sqrt(np.mean(np.diff(self.angle) ** 2))) * self.sample_rate

    @property
    def has_mean_speed(self) -> bool:
        """Whether the mean speed is at least `MEAN` times the rms, so that it defines frequencies.

        That of a shaft that reverses is near zero.
        """
        return abs(self.speed) >= MEAN * self.rms_speed

    def within(self, begin: float | None, end: float | None) -> Self:
        """The longest uniformly sampled segment of an interval.

        Args:
            begin: start of the interval [s]; None is the start of the signal.
            end: end of the interval [s]; None is the end of the signal.

        Returns:
            The segment, with remarks if it is shorter than the interval or its sample rate is
            reduced.

        Raises:
            RecordingError: there is no such segment.
        """
        low = self.time[0] if begin is None else begin
        high = self.time[-1] if end is None else end
        inside = np.flatnonzero((self.time >= low) & (self.time <= high))
        try:
            part = inside[longest_segment(self.time[inside])]
        except ValueError as error:
            raise RecordingError(
                f"from {low:g} to {high:g} s: {error}; "
                f"the signal runs from {self.time[0]:g} to {self.time[-1]:g} s"
            ) from None
        remarks = self.remarks
        if len(part) < len(inside):
            first, last = self.time[part[[0, -1]]]
            remarks += (
                "samples are missing or the sample rate changes: only the longest uniformly "
                f"sampled segment is analysed, {first:.4f} to {last:.4f} s",
            )
        rate, full = sample_rate(self.time[part]), full_rate(self.time)
        if rate < 0.99 * full:
            remarks += (
                f"the sample rate is reduced from {full:.0f} to {rate:.0f} Hz: components above "
                f"{0.5 * rate:.0f} Hz appear as aliases",
            )
        return replace(
            self,
            samples=self.samples[part],
            time=self.time[part],
            angle=self.angle[part],
            remarks=remarks,
        )


def read_signal(path: Path, mesh: str, quantity: str) -> Signal:
    """Read a signal.

    Args:
        path: of a recording, or of an .npz file of `simulate`.
        mesh: name of the mesh.
        quantity: one of `QUANTITIES`.

    Returns:
        The whole signal.

    Raises:
        RecordingError: the file is neither, or the mesh or quantity does not exist.
    """
    if quantity not in QUANTITIES:
        raise RecordingError(f"quantity = {quantity!r}: must be one of {', '.join(QUANTITIES)}")
    if path.suffix == ".npz":
        return _of_run(path, mesh, quantity)
    return of_recording(read_recording(path), mesh, quantity)


def of_recording(recording: Recording, mesh: str, quantity: str) -> Signal:
    """Signal of a mesh in a recording.

    Args:
        recording: with waveform.
        mesh: name of the mesh.
        quantity: one of `QUANTITIES`.

    Returns:
        The whole signal, with angles interpolated between the recorded states.

    Raises:
        RecordingError: the mesh does not exist, or the recording has no waveform.
    """
    wave = recording.waveform
    if wave is None:
        raise RecordingError(f"{recording.path}: contains no mesh_waveform message")
    column = _column(mesh, recording.meshes)
    return Signal(
        getattr(wave, quantity)[:, column].astype(np.float64),
        wave.time,
        relative_angle(recording, wave.time),
        recording.scene_yaml,
        tuple(recording.remarks),
    )


def relative_angle(recording: Recording, time: Array) -> Array:
    """Angle of the sun relative to the carrier [rad], (n,), continuous over turns.

    Args:
        recording: gives the recorded angles and speeds.
        time: at which to interpolate [s], (n,).
    """
    state = recording.state
    sun, carrier = (
        unwrap(state.time, state[f"{member}_angle"], state[f"{member}_speed"])
        for member in ("sun", "carrier")
    )
    return np.asarray(PchipInterpolator(state.time, sun - carrier)(time), dtype=np.float64)


def _of_run(path: Path, mesh: str, quantity: str) -> Signal:
    def signal(stored: dict[str, Any]) -> Signal:
        samples = _values(stored, quantity)[:, _column(mesh, tuple(stored["meshes"].tolist()))]
        return Signal(samples, stored["time"], _angle_of_run(stored), _scene_of_run(stored))

    return _from_run(path, signal)


def sensor_of_run(path: Path, name: str) -> tuple[Signal, str]:
    """Signal of a sensor in an .npz file of `simulate`, and its unit.

    Args:
        path: of the file.
        name: of the sensor.

    Raises:
        RecordingError: it is no such file, or has no such sensor with a waveform.
    """

    def signal(stored: dict[str, Any]) -> tuple[Signal, str]:
        keys = [key for key in stored if key.startswith("sensors.") and key.endswith(".values")]
        known = [key.split(".")[1] for key in keys if stored[key].dtype.kind == "f"]
        if name not in known:
            listed = ", ".join(known) or "none: the run has no samples of a sensor"
            raise RecordingError(f"{path}: sensor = {name!r}: must be one of {listed}")
        time, values = stored[f"sensors.{name}.time"], stored[f"sensors.{name}.values"]
        inside = (time >= stored["time"][0]) & (time <= stored["time"][-1])
        angle = np.interp(time[inside], stored["time"], _angle_of_run(stored))
        found = Signal(values[inside], time[inside], angle, _scene_of_run(stored))
        return found, str(stored[f"sensors.{name}.unit"])

    return _from_run(path, signal)


def _angle_of_run(stored: dict[str, Any]) -> Array:
    """Angle of the sun relative to the carrier at the samples [rad], (n,)."""
    bodies = stored["bodies"].tolist()
    sun, carrier = (stored["angle"][:, bodies.index(name)] for name in ("sun", "carrier"))
    return np.asarray(sun - carrier, dtype=np.float64)


def _scene_of_run(stored: dict[str, Any]) -> str | None:
    return str(stored["scene_yaml"]) if "scene_yaml" in stored else None


def _from_run(path: Path, signal: Callable[[dict[str, Any]], T]) -> T:
    """What a function makes of the arrays of a file of `simulate`."""
    try:
        with np.load(path) as arrays:
            return signal({name: arrays[name] for name in arrays.files})
    except FileNotFoundError:
        raise RecordingError(f"{path}: no such file or folder") from None
    except RecordingError:
        raise
    except (BadZipFile, ValueError, KeyError, EOFError, OSError) as error:
        raise RecordingError(f"{path}: not a file of `simulate`: {error}") from None


def _values(stored: dict[str, Any], quantity: str) -> Any:
    if quantity == "friction":
        return stored["boundary_friction"] + stored["viscous_friction"]
    return stored[quantity]


def _column(mesh: str, meshes: tuple[str, ...]) -> int:
    if mesh not in meshes:
        raise RecordingError(f"mesh = {mesh!r}: must be one of {', '.join(meshes)}")
    return meshes.index(mesh)


def settled(file: Path, signal: Signal) -> Signal:
    """The longest settled part of a signal at one operating point, or all of it.

    Args:
        file: of the signal.
        signal: all of it.

    Returns:
        The part, with a remark if a recording has no such part; all of a signal from another file.
    """
    if file.suffix == ".npz" or is_table(file):
        return signal.within(None, None)
    if span := steady_span(file):
        return signal.within(*span)
    whole = signal.within(None, None)
    line = f"{file}: no settled interval at one operating point was found; all of it is analysed"
    return replace(whole, remarks=(*whole.remarks, line))


def squared_envelope(signal: Signal, band: Band) -> Signal:
    """The squared envelope of a band of a signal, in the squared unit (Ho and Randall 2000).

    Args:
        signal: uniformly spaced.
        band: that is demodulated [Hz].

    Raises:
        ValueError: the band is not below half the sample rate, or contains no line of the
            spectrum.
    """
    if band.high > 0.5 * signal.sample_rate:
        raise ValueError(
            f"envelope = '{band.low:g}:{band.high:g}': must be below half the sample rate, "
            f"{0.5 * signal.sample_rate:g} Hz"
        )
    return replace(signal, samples=envelope(signal.samples, signal.sample_rate, band) ** 2)
