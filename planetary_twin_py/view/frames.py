"""Windows of the DTE of one mesh along a recording, for spectra and phase portraits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..analysis.sampling.segments import reduced_rate, uniform_segments
from ..recording.runs.reader import Recording
from . import timeline

Array = NDArray[np.float64]
MESH = 0  # sun_planet_1
STEP = 0.1  # [s] between windows
MOST = 300  # windows; in recordings longer than 30 s their distance is larger


@dataclass(frozen=True)
class Frames:
    """Centres of the windows, `time` [s] and `stamp` [ns] (n,), and `segments` without gaps."""

    recording: Recording
    time: Array
    stamp: NDArray[np.int64]
    segments: list[slice]

    @property
    def index(self) -> list[rr.TimeColumn]:
        """Time columns for `rr.send_columns`."""
        return timeline.columns(self.time, self.stamp)

    @property
    def remark(self) -> str | None:
        """Warning if samples are decimated somewhere."""
        wave = self.recording.waveform
        return None if wave is None else reduced_rate(wave.time, self.segments)

    def lasting(self, seconds: float, cycles: float) -> float:
        """Duration of a window [s].

        Args:
            seconds: minimum duration [s].
            cycles: minimum number of mesh cycles at the median speed.

        Returns:
            The larger of both, limited to the longest uniformly sampled segment.
        """
        wave, mesh = self.recording.waveform, self.recording.state["mesh_frequency"]
        assert wave is not None
        usual = float(np.nanmedian(mesh)) if np.isfinite(mesh).any() else 0.0
        longest = max(
            (float(wave.time[part.stop - 1] - wave.time[part.start]) for part in self.segments),
            default=0.0,
        )
        return min(max(seconds, cycles / usual if usual > 0.0 else 0.0), max(seconds, longest))

    def state(self, name: str) -> Array:
        """A field of GearboxState at the centres of the windows (n,)."""
        state = self.recording.state
        row = np.minimum(np.searchsorted(state.time, self.time), len(state) - 1)
        return np.asarray(state[name][row], dtype=np.float64)

    def window(self, number: int, duration: float) -> tuple[Array, Array] | None:
        """Time [s] and DTE [m] of a gap-free window.

        Args:
            number: index of the window.
            duration: duration of the window [s].

        Returns:
            The samples, near a gap or an end from a shifted window; None if no window fits.
        """
        wave, now = self.recording.waveform, self.time[number]
        assert wave is not None
        for part in self.segments:
            first, last = wave.time[part.start], wave.time[part.stop - 1]
            if first <= now <= last and last - first >= duration:
                begin = min(max(now - 0.5 * duration, first), last - duration)
                ends = np.searchsorted(wave.time[part], (begin, begin + duration)) + part.start
                inside = slice(int(ends[0]), int(ends[1]))
                return wave.time[inside], wave.dte[inside, MESH].astype(np.float64)
        return None


def frames(recording: Recording) -> Frames | None:
    """Windows from the first sample to the last; None without samples.

    Args:
        recording: has the waveform.
    """
    wave = recording.waveform
    if wave is None or len(wave.time) < 2:
        return None
    first, last = wave.time[0], wave.time[-1]
    count = min(int((last - first) / STEP) + 1, MOST)
    time = np.linspace(first, last, max(count, 2))
    row = np.minimum(np.searchsorted(wave.time, time), len(wave.time) - 1)
    stamp = wave.stamp[row] + np.rint(1e9 * (time - wave.time[row])).astype(np.int64)
    return Frames(recording, time, stamp, uniform_segments(wave.time))
