"""Quantities that a test rig measures, from a recording and from a simulation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...recording.ros2.fields import state_fields
from ...run.window import Window
from ...units.catalogue import MEMBERS, MESH, SIDES, TRAIN
from .excerpt import Excerpt

Array = NDArray[np.float64]

HARMONICS = "dte_waveform"
ORDERS = 6  # harmonics of the mesh frequency that describe a waveform
USUAL = ("dte_rms", "power_loss")
"""Measured by most rigs: transmission error from two encoders of unknown zero, and power loss."""
OBSERVABLES = (*TRAIN, *(name for name in MESH if name not in TRAIN), HARMONICS)


@dataclass(frozen=True)
class Readings:
    """One observable over an excerpt.

    `values` (readings, channels): a row for each interval, or mesh cycle; a column for each mesh.
    `kinds` (channels,): channels of one number have the same noise. `segment` (readings,): counts
    the operating points, up to that of the row.
    """

    name: str
    values: Array
    kinds: NDArray[np.int64]
    segment: NDArray[np.int64]


class IntervalReadings(NamedTuple):
    """Published quantities of an interval, recorded or simulated."""

    end: float  # simulated [s]
    length: float  # [s]
    fields: dict[str, Any]  # of GearboxState
    time: Array  # of samples, simulated [s]
    dte: Array  # (samples, meshes) [m]


def check_observables(names: Sequence[str]) -> None:
    """Raise `ValueError` if there is no name, an unknown name, or a name occurs twice."""
    if not names:
        raise ValueError("no observable: name at least one, e.g. dte_rms")
    for name in names:
        if name not in OBSERVABLES:
            raise ValueError(f"observe = {name}: must be one of {', '.join(OBSERVABLES)}")
        if list(names).count(name) > 1:
            raise ValueError(f"observe = {name}: given twice")


def usual_observables(excerpt: Excerpt) -> tuple[str, ...]:
    """Those of `USUAL` that were recorded.

    Raises `ValueError` if none was.
    """
    found = tuple(name for name in USUAL if _present(name, excerpt).any())
    if not found:
        others = [n for n in OBSERVABLES if n != HARMONICS and _present(n, excerpt).any()]
        raise ValueError(
            f"observe: is required, because this excerpt has neither {' nor '.join(USUAL)}; has "
            f"{', '.join(others) or 'none of the observables'}"
        )
    return found


def recorded(excerpt: Excerpt) -> list[IntervalReadings]:
    """The intervals of an excerpt as recorded."""
    meshes = 2 * int(excerpt.states[0].planets)
    blocks = excerpt.blocks
    time = _joined([b.start_time + np.arange(b.samples) * b.sample_period for b in blocks])
    dte = np.concatenate(
        [np.empty((0, meshes)), *(b.dte.reshape(meshes, -1).T.astype(float) for b in blocks)]
    )
    ends = [state.simulated_time for state in excerpt.states]
    cuts = np.searchsorted(time, np.array(ends) + 1e-9)
    cuts = np.concatenate([[0], cuts])
    return [
        IntervalReadings(state.simulated_time, state.interval, vars(state), time[a:b], dte[a:b])
        for state, a, b in zip(excerpt.states, cuts, cuts[1:], strict=False)
    ]


def simulated(window: Window, begins: float) -> IntervalReadings:
    """The quantities that a twin that starts at `begins` [s] would publish of a window."""
    names = [f"{side}_{name}" for side in SIDES for name in MESH]
    wave = window.waveform
    length = window.end - window.start
    fields = state_fields(window, names)
    return IntervalReadings(begins + window.end, length, fields, begins + wave.time, wave.dte)


def read(name: str, intervals: Sequence[IntervalReadings], excerpt: Excerpt) -> Readings:
    """Readings of one observable, for the meshes for which it was recorded.

    Raises `ValueError` if there is none.
    """
    if name == HARMONICS:
        return _harmonics(intervals, excerpt)
    present = _present(name, excerpt)
    if not present.any():
        raise ValueError(f"observe = {name}: was not recorded in this excerpt")
    rows = np.array([_row(name, interval.fields) for interval in intervals])
    ends = np.array([interval.end for interval in intervals])
    kinds = _kinds(rows.shape[1])
    return Readings(name, rows[:, present], kinds[present], _segments(ends, excerpt))


def _present(name: str, excerpt: Excerpt) -> NDArray[np.bool_]:
    """Whether each channel of an observable was recorded, (channels,)."""
    rows = np.array([_row(name, vars(state)) for state in excerpt.states])
    return np.asarray(~np.isnan(rows).all(axis=0))


def _row(name: str, fields: Mapping[str, Any]) -> Array:
    if name in TRAIN:
        return np.array([fields[name]], dtype=float)
    planets = int(fields["planets"])
    return np.concatenate([fields[f"{side}_{name}"][:planets] for side in SIDES])


def _kinds(channels: int) -> NDArray[np.int64]:
    """0 for sun meshes, 1 for ring meshes; a single channel describes the whole train."""
    return np.arange(channels) * 2 // channels


def _segments(time: Array, excerpt: Excerpt) -> NDArray[np.int64]:
    """Number of changes of the operating point before each `time` [s]."""
    return np.searchsorted(np.array(excerpt.segments), time - 1e-12)


def _harmonics(intervals: Sequence[IntervalReadings], excerpt: Excerpt) -> Readings:
    """Amplitudes of the DTE at harmonics of the mesh frequency, for each mesh cycle.

    Cycles follow from the angles of the gears, so they do not depend on speed or start time. The
    mean is omitted because the zero of the encoders is unknown.
    """
    time = _joined([interval.time for interval in intervals])
    phase = _mesh_phase(intervals, excerpt, time)
    dte = np.concatenate([interval.dte for interval in intervals])
    cycle = np.floor(phase).astype(np.int64)
    if not len(cycle):
        raise ValueError(f"observe = {HARMONICS}: no waveform was recorded in this excerpt")
    starts = np.searchsorted(cycle, np.arange(cycle[0] + 1, cycle[-1] + 1))
    rows, middles = [], []
    for first, last in pairwise(starts):
        if last - first <= 2 * ORDERS:
            raise ValueError(
                f"observe = {HARMONICS}: {last - first} samples in a mesh cycle, must be more "
                f"than {2 * ORDERS}"
            )
        rows.append(_amplitudes(phase[first:last], dte[first:last]))
        middles.append(0.5 * (time[first] + time[last - 1]))
    if len(rows) < 2:
        raise ValueError(
            f"observe = {HARMONICS}: must have two complete mesh cycles in this excerpt"
        )
    values = np.array(rows)
    return Readings(
        HARMONICS, values, _kinds(values.shape[1]), _segments(np.array(middles), excerpt)
    )


def _mesh_phase(intervals: Sequence[IntervalReadings], excerpt: Excerpt, time: Array) -> Array:
    """Mesh cycles at `time` [s], counted from the start of a cycle in the first interval."""
    sun, _, carrier = (f"{member}_angle" for member in MEMBERS)
    teeth = excerpt.scene.gearset.teeth.sun
    first = intervals[0]
    phase = teeth * (first.fields[sun] - first.fields[carrier]) / (2.0 * math.pi) % 1.0
    times, phases = [first.end - first.length], [0.0]
    for before, interval in zip([None, *intervals], intervals, strict=False):
        if before and interval.end - interval.length > before.end + 1e-9:
            raise ValueError(
                f"observe = {HARMONICS}: intervals are missing before {interval.end:g} s"
            )
        rate = interval.fields["sun_speed"] - interval.fields["carrier_speed"]
        times.append(interval.end)
        phases.append(phases[-1] + teeth * rate / (2.0 * math.pi) * interval.length)
    turned = np.interp(time, times, phases) - phases[1] + phase
    return np.asarray(turned if phases[-1] >= 0.0 else -turned)


def _amplitudes(phase: Array, dte: Array) -> Array:
    """Cosine and sine amplitudes of `dte` (samples, meshes) over one cycle, mesh by mesh."""
    angle = 2.0 * math.pi * phase[:, None] * np.arange(1, ORDERS + 1)
    waves = np.concatenate([np.ones((len(phase), 1)), np.cos(angle), np.sin(angle)], axis=1)
    coefficients: Array = np.linalg.lstsq(waves, dte, rcond=None)[0][1:]
    return coefficients.T.ravel()


def _joined(parts: Iterable[Array]) -> Array:
    return np.concatenate([np.empty(0), *parts])
