"""Every sample of the vibration: its range for the overview, and the samples of two meshes to zoom.

The range (smallest and largest value in each recorded block) of all meshes shows the whole run at a
hundredth of the samples. One mesh of each kind is shown sample by sample: all of them would make
the file three times as large, and they repeat the same curve at another phase.
"""

from __future__ import annotations

import numpy as np
import rerun as rr

from ..recording.reader import Recording
from ..recording.waveform import Waveform
from . import timeline
from .plots import log_series, mesh_colours
from .quantities import WAVEFORM

# 30 s at 50 kHz: some 100 MB in the viewer. A longer recording shows the samples of its first part.
MOST_SAMPLES = 1_500_000
_CHUNK = 50_000  # samples sent at once, so that the viewer loads only the part it shows


def log_waveform(stream: rr.RecordingStream, recording: Recording) -> str | None:
    """Log ranges at /range/NAME and samples at /waveform/NAME; a remark if samples are left out."""
    waveform = recording.waveform
    if waveform is None or not len(waveform.time):
        return f"{recording.path}: no mesh_waveform message in it, so no samples are shown"
    _log_ranges(stream, recording, waveform)
    for start in range(0, min(len(waveform.time), MOST_SAMPLES), _CHUNK):
        _log_samples(stream, recording, waveform, slice(start, min(start + _CHUNK, MOST_SAMPLES)))
    if len(waveform.time) <= MOST_SAMPLES:
        return None
    return (
        f"single samples are shown up to {waveform.time[MOST_SAMPLES]:.1f} s of "
        f"{waveform.time[-1]:.1f} s, their range to the end"
    )


def _log_ranges(stream: rr.RecordingStream, recording: Recording, waveform: Waveform) -> None:
    index = timeline.columns(waveform.time[waveform.block], waveform.stamp[waveform.block])
    names = [f"{mesh}_{end}" for mesh in recording.meshes for end in ("min", "max")]
    colours = [colour for colour in mesh_colours(recording.planets) for _ in range(2)]
    for name, quantity in WAVEFORM.items():
        samples = getattr(waveform, name)
        ends = [reduce.reduceat(samples, waveform.block, axis=0) for reduce in (np.fmin, np.fmax)]
        values = quantity.factor * np.stack(ends, axis=2).reshape(len(waveform.block), -1)
        log_series(stream, f"range/{name}", index, values, names, colours)


def _log_samples(
    stream: rr.RecordingStream, recording: Recording, waveform: Waveform, part: slice
) -> None:
    index = timeline.columns(waveform.time[part], waveform.stamp[part])
    shown = [0, recording.planets]  # sun_planet_1 and planet_ring_1
    names = [recording.meshes[mesh] for mesh in shown]
    colours = [mesh_colours(recording.planets)[mesh] for mesh in shown]
    for name, quantity in WAVEFORM.items():
        values = quantity.factor * getattr(waveform, name)[part][:, shown].astype(np.float64)
        log_series(stream, f"waveform/{name}", index, values, names, colours)
