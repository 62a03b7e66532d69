"""The vibration: ranges of all meshes for an overview, and samples of two meshes.

Ranges (smallest and largest value in each recorded block) show the whole run with a hundredth of
the data. One mesh of each kind is shown sample by sample; the others repeat the same curve with a
phase shift, and would make the file three times as large.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..recording.runs.reader import Recording
from ..recording.runs.waveform import Ranges, TimeSpan, Waveform
from ..units.catalogue import WAVEFORM, WAVEFORM_VIEWS
from . import timeline
from .detail import first_rows
from .layer import Layer
from .plots import log_series, mesh_colours

_CHUNK = 50_000  # samples per chunk; the viewer loads only visible chunks


def log_waveform(layer: Layer, recording: Recording, detail: list[TimeSpan]) -> str | None:
    """Log ranges at /range/NAME and samples at /waveform/NAME.

    Args:
        layer: recording to draw into.
        recording: has the waveform.
        detail: time spans [s] of the samples.

    Returns:
        A warning if samples are not shown, else None.
    """
    ranges = recording.ranges
    if ranges is None:
        return f"{recording.path}: has no mesh_waveform messages, so no samples are shown"
    _log_ranges(layer, recording, ranges, detail)
    for begin, end in detail:
        _log_span(layer, recording, np.arange(begin, end, _CHUNK * ranges.period.min()), end)
    begin, end = detail[0]
    if begin <= ranges.time[0] and end >= recording.state.time[-1]:
        return None
    shown = f"{begin:g} to {end:g} s" if len(detail) == 1 else "the start and the changes"
    return (
        f"single samples are shown for {shown} ({sum(b - a for a, b in detail):.1f} s of "
        f"{recording.state.time[-1]:.1f} s), and their range for the whole recording; use --during "
        "to select another interval"
    )


def _log_ranges(layer: Layer, recording: Recording, ranges: Ranges, detail: list[TimeSpan]) -> None:
    begins = first_rows(ranges.time, detail)
    index = timeline.columns(ranges.time[begins], ranges.stamp[begins])
    names = [f"{mesh}_{end}" for mesh in recording.meshes for end in ("min", "max")]
    colours = [colour for colour in mesh_colours(recording.planets) for _ in range(2)]
    for name in WAVEFORM_VIEWS:
        quantity = WAVEFORM[name]
        ends = (
            np.fmin.reduceat(ranges.lowest[name], begins, axis=0),
            np.fmax.reduceat(ranges.highest[name], begins, axis=0),
        )
        values = quantity.factor * np.stack(ends, axis=2).reshape(len(begins), -1)
        log_series(layer, f"range/{name}", index, values, names, colours)


def _log_span(layer: Layer, recording: Recording, begins: NDArray[np.float64], end: float) -> None:
    """Log the samples in chunks that start at `begins` [s], up to `end` [s]."""
    for first, last in pairwise([*begins, np.nextafter(end, np.inf)]):
        waveform = recording.samples(first, last)
        if waveform is not None:
            _log_samples(layer, recording, waveform, first, last)


def _log_samples(
    layer: Layer,
    recording: Recording,
    waveform: Waveform,
    first: float,
    last: float,
) -> None:
    part = (first <= waveform.time) & (waveform.time < last)
    index = timeline.columns(waveform.time[part], waveform.stamp[part])
    shown = [0, recording.planets]  # sun_planet_1 and planet_ring_1
    names = [recording.meshes[mesh] for mesh in shown]
    colours = [mesh_colours(recording.planets)[mesh] for mesh in shown]
    for name in WAVEFORM_VIEWS:
        quantity = WAVEFORM[name]
        values = quantity.factor * getattr(waveform, name)[:, shown][part].astype(np.float64)
        log_series(layer, f"waveform/{name}", index, values, names, colours)
