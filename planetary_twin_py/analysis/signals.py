"""What to analyse: one quantity of one mesh, from a recording or from the samples of a run."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self
from zipfile import BadZipFile

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from ..recording.container.records import RecordingError
from ..recording.runs.reader import Recording, read_recording
from ..recording.runs.unwrapping import unwrap
from .stretches import full_rate, longest_stretch, sample_rate

Array = NDArray[np.float64]
QUANTITIES = {"dte": "m", "mesh_force": "N", "friction": "N"}


@dataclass(frozen=True)
class Signal:
    """`samples` (n,) of a quantity in SI at `time` [s] (n,), evenly; angles (n,) in rad.

    `angle` is that of the sun against the carrier, in which a mesh has the sun's number of teeth
    as its order, whatever is held.
    """

    samples: Array
    time: Array
    angle: Array
    scene_yaml: str | None
    remarks: tuple[str, ...] = ()

    @property
    def sample_rate(self) -> float:
        """[Hz]."""
        return sample_rate(self.time)

    @property
    def speed(self) -> float:
        """Mean of the sun against the carrier [rad/s]."""
        return float((self.angle[-1] - self.angle[0]) / (self.time[-1] - self.time[0]))

    def within(self, begin: float | None, end: float | None) -> Self:
        """The longest even stretch from `begin` to `end` [s]; a remark tells what that leaves out.

        Raises:
            RecordingError: there is none.
        """
        low = self.time[0] if begin is None else begin
        high = self.time[-1] if end is None else end
        inside = np.flatnonzero((self.time >= low) & (self.time <= high))
        try:
            part = inside[longest_stretch(self.time[inside])]
        except ValueError as error:
            raise RecordingError(
                f"from {low:g} to {high:g} s: {error}; "
                f"the signal runs from {self.time[0]:g} to {self.time[-1]:g} s"
            ) from None
        remarks = self.remarks
        if len(part) < len(inside):
            first, last = self.time[part[[0, -1]]]
            remarks += (
                f"samples are missing or change their rate: analysed is the longest stretch "
                f"without, {first:.4f} to {last:.4f} s",
            )
        rate, full = sample_rate(self.time[part]), full_rate(self.time)
        if rate < 0.99 * full:
            remarks += (
                f"samples come at {rate:.0f} in place of {full:.0f} Hz: what lies above "
                f"{0.5 * rate:.0f} Hz folds back below it",
            )
        return type(self)(
            self.samples[part], self.time[part], self.angle[part], self.scene_yaml, remarks
        )


def read_signal(path: Path, mesh: str, quantity: str, namespace: str | None = None) -> Signal:
    """The `quantity` of `mesh` in the recording or the .npz file of `simulate` at `path`.

    Raises:
        RecordingError: `path` is neither, or holds no such mesh or quantity.
    """
    if quantity not in QUANTITIES:
        raise RecordingError(f"quantity = {quantity!r}: must be one of {', '.join(QUANTITIES)}")
    if path.suffix == ".npz":
        return _of_run(path, mesh, quantity)
    return of_recording(read_recording(path, namespace), mesh, quantity)


def of_recording(recording: Recording, mesh: str, quantity: str) -> Signal:
    """The `quantity` of `mesh`; angles between two states run smoothly through the recorded ones.

    Raises:
        RecordingError: there is no such mesh, or no waveform.
    """
    wave = recording.waveform
    if wave is None:
        raise RecordingError(f"{recording.path}: no mesh_waveform message in it")
    column = _column(mesh, recording.meshes)
    return Signal(
        getattr(wave, quantity)[:, column].astype(np.float64),
        wave.time,
        relative_angle(recording, wave.time),
        recording.scene_yaml,
        tuple(recording.remarks),
    )


def relative_angle(recording: Recording, time: Array) -> Array:
    """Angle of the sun against the carrier [rad] at `time` [s] (n,), continuous."""
    state = recording.state
    sun, carrier = (
        unwrap(state.time, state[f"{member}_angle"], state[f"{member}_speed"])
        for member in ("sun", "carrier")
    )
    return np.asarray(PchipInterpolator(state.time, sun - carrier)(time), dtype=np.float64)


def _of_run(path: Path, mesh: str, quantity: str) -> Signal:
    try:
        with np.load(path) as arrays:
            held = {name: arrays[name] for name in arrays.files}
        bodies = held["bodies"].tolist()
        angle = held["angle"][:, bodies.index("sun")] - held["angle"][:, bodies.index("carrier")]
        samples = _values(held, quantity)[:, _column(mesh, tuple(held["meshes"].tolist()))]
        scene = str(held["scene_yaml"]) if "scene_yaml" in held else None
        return Signal(samples, held["time"], angle, scene)
    except FileNotFoundError:
        raise RecordingError(f"{path}: no such file or folder") from None
    except RecordingError:
        raise
    except (BadZipFile, ValueError, KeyError, EOFError, OSError) as error:
        raise RecordingError(f"{path}: no samples of `simulate`: {error}") from None


def _values(held: dict[str, Any], quantity: str) -> Any:
    if quantity == "friction":
        return held["boundary_friction"] + held["viscous_friction"]
    return held[quantity]


def _column(mesh: str, meshes: tuple[str, ...]) -> int:
    if mesh not in meshes:
        raise RecordingError(f"mesh = {mesh!r}: must be one of {', '.join(meshes)}")
    return meshes.index(mesh)
