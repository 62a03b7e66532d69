"""Windows of the DTE of one mesh along a recording, for what is seen of a stretch of time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..analysis.stretches import even_stretches, thinned
from ..recording.runs.reader import Recording
from . import timeline

Array = NDArray[np.float64]
MESH = 0  # sun_planet_1
STEP = 0.1  # [s] between two windows
MOST = 300  # windows; of more than half a minute they lie further apart


@dataclass(frozen=True)
class Frames:
    """`time` [s] and `stamp` [ns] (n,) of the instants; the even `stretches` of the samples."""

    recording: Recording
    time: Array
    stamp: NDArray[np.int64]
    stretches: list[slice]

    @property
    def index(self) -> list[rr.TimeColumn]:
        """For `rr.send_columns`."""
        return timeline.columns(self.time, self.stamp)

    @property
    def remark(self) -> str | None:
        """Where samples are thinned, if anywhere."""
        wave = self.recording.waveform
        return None if wave is None else thinned(wave.time, self.stretches)

    def lasting(self, seconds: float, cycles: float) -> float:
        """A duration [s] of so many `seconds`, or mesh cycles at the usual speed if that is longer.

        Not longer than the longest stretch of samples.
        """
        wave, mesh = self.recording.waveform, self.recording.state["mesh_frequency"]
        assert wave is not None
        usual = float(np.nanmedian(mesh)) if np.isfinite(mesh).any() else 0.0
        longest = max(
            (float(wave.time[part.stop - 1] - wave.time[part.start]) for part in self.stretches),
            default=0.0,
        )
        return min(max(seconds, cycles / usual if usual > 0.0 else 0.0), max(seconds, longest))

    def state(self, name: str) -> Array:
        """A field of GearboxState at the instants (n,): of the interval each lies in."""
        state = self.recording.state
        row = np.minimum(np.searchsorted(state.time, self.time), len(state) - 1)
        return np.asarray(state[name][row], dtype=np.float64)

    def window(self, number: int, duration: float) -> tuple[Array, Array] | None:
        """Time [s] and DTE [m] of `duration` [s] around an instant, without a gap in it.

        Near a gap or an end the window is moved to where it fits; None where it does not.
        """
        wave, now = self.recording.waveform, self.time[number]
        assert wave is not None
        for part in self.stretches:
            first, last = wave.time[part.start], wave.time[part.stop - 1]
            if first <= now <= last and last - first >= duration:
                begin = min(max(now - 0.5 * duration, first), last - duration)
                ends = np.searchsorted(wave.time[part], (begin, begin + duration)) + part.start
                inside = slice(int(ends[0]), int(ends[1]))
                return wave.time[inside], wave.dte[inside, MESH].astype(np.float64)
        return None


def frames(recording: Recording) -> Frames | None:
    """Instants from the first sample to the last; None without samples."""
    wave = recording.waveform
    if wave is None or len(wave.time) < 2:
        return None
    first, last = wave.time[0], wave.time[-1]
    count = min(int((last - first) / STEP) + 1, MOST)
    time = np.linspace(first, last, max(count, 2))
    row = np.minimum(np.searchsorted(wave.time, time), len(wave.time) - 1)
    stamp = wave.stamp[row] + np.rint(1e9 * (time - wave.time[row])).astype(np.int64)
    return Frames(recording, time, stamp, even_stretches(wave.time))
