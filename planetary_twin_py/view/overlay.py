"""Several recordings on one time axis: their names and differences."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..recording.container.records import RecordingError
from ..recording.runs.reader import Recording
from ..recording.runs.waveform import QUANTITIES, Waveform, WaveformInMemory

DIFFERENCE = "difference"
"""Parent of the entities of differences."""
_COINCIDE = 1e-9  # [s], largest difference of coinciding samples; the time axis has nanoseconds


def names_of(recordings: Sequence[Recording]) -> list[str]:
    """A name for each recording: of its file, or its path if several files have the same name.

    Args:
        recordings: recordings, at least one; the name of a single recording is "".

    Raises:
        RecordingError: a recording occurs twice.
    """
    if len(recordings) == 1:
        return [""]
    stems = Counter(recording.path.stem for recording in recordings)
    names = [
        recording.path.stem if stems[recording.path.stem] == 1 else str(recording.path)
        for recording in recordings
    ]
    if len(set(names)) < len(names):
        raise RecordingError(f"{Counter(names).most_common(1)[0][0]}: given twice")
    return names


def difference(first: Recording, other: Recording) -> Recording:
    """`other` with its waveform minus that of `first`, at the times of samples of both.

    Raises:
        RecordingError: no sample times coincide, or the meshes differ.
    """
    if first.meshes != other.meshes:
        raise RecordingError(
            f"{other.path}: has {other.planets} planets, but {first.path} has {first.planets}, "
            "so no difference is drawn"
        )
    if first.waveform is None or other.waveform is None:
        raise RecordingError(f"{other.path}: a waveform is missing, so no difference is drawn")
    waveform = _subtract(first.waveform, other.waveform)
    if not len(waveform.time):
        raise RecordingError(
            f"{other.path}: no sample has the same time as one of {first.path}, "
            "so no difference is drawn"
        )
    return replace(other, blocks=WaveformInMemory(waveform))


def _subtract(first: Waveform, other: Waveform) -> Waveform:
    nearest = np.searchsorted(first.time, other.time - _COINCIDE)
    nearest = np.minimum(nearest, len(first.time) - 1)
    rows = np.flatnonzero(np.abs(first.time[nearest] - other.time) <= _COINCIDE)
    nearest = nearest[rows]
    blocks = np.unique(np.searchsorted(rows, other.block))
    return Waveform(
        time=other.time[rows],
        stamp=other.stamp[rows],
        block=blocks[blocks < len(rows)],
        **{name: getattr(other, name)[rows] - getattr(first, name)[nearest] for name in QUANTITIES},
    )
