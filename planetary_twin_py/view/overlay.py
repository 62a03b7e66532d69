"""Several recordings on one time axis: what they are called, and by how much they differ."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..recording.container.records import RecordingError
from ..recording.runs.reader import Recording
from ..recording.runs.waveform import Held, Waveform

DIFFERENCE = "difference"
"""What the differences stand below."""
_COINCIDE = 1e-9  # [s] at most between samples of one instant: the time axis counts nanoseconds


def names_of(recordings: Sequence[Recording]) -> list[str]:
    """A name for each, "" for one alone: that of its file, or its path where files share a name.

    Raises:
        RecordingError: one of them is there twice.
    """
    if len(recordings) == 1:
        return [""]
    stems = Counter(recording.path.stem for recording in recordings)
    names = [
        recording.path.stem if stems[recording.path.stem] == 1 else str(recording.path)
        for recording in recordings
    ]
    if len(set(names)) < len(names):
        raise RecordingError(f"{Counter(names).most_common(1)[0][0]}: is to be shown twice")
    return names


def difference(first: Recording, other: Recording) -> Recording:
    """`other` with the waveform less that of `first`, where both have a sample of one instant.

    Raises:
        RecordingError: there is no such instant, or the meshes are not the same.
    """
    if first.meshes != other.meshes:
        raise RecordingError(
            f"{other.path}: has {other.planets} planets, {first.path} {first.planets}, "
            "so no difference is drawn"
        )
    if first.waveform is None or other.waveform is None:
        raise RecordingError(f"{other.path}: no difference is drawn without both waveforms")
    less = _less(first.waveform, other.waveform)
    if not len(less.time):
        raise RecordingError(
            f"{other.path}: no sample is of the same instant as one of {first.path}, "
            "so no difference is drawn"
        )
    return replace(other, blocks=Held(less))


def _less(first: Waveform, other: Waveform) -> Waveform:
    near = np.searchsorted(first.time, other.time - _COINCIDE)
    near = np.minimum(near, len(first.time) - 1)
    rows = np.flatnonzero(np.abs(first.time[near] - other.time) <= _COINCIDE)
    near = near[rows]
    blocks = np.unique(np.searchsorted(rows, other.block))
    return Waveform(
        time=other.time[rows],
        stamp=other.stamp[rows],
        block=blocks[blocks < len(rows)],
        dte=other.dte[rows] - first.dte[near],
        mesh_force=other.mesh_force[rows] - first.mesh_force[near],
        friction=other.friction[rows] - first.friction[near],
    )
