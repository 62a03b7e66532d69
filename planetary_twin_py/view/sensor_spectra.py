"""Spectrum, order spectrum and envelope spectrum of a sensor around the time cursor."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import rerun as rr

from ..analysis.lines.line_names import LineNames
from ..analysis.lines.mesh_spectrum import MeshSpectrum, frequency_spectrum_of, order_spectrum_of
from ..analysis.signals.signal import Signal, relative_angle, squared_envelope
from ..analysis.spectra.band import Band
from ..recording.container.records import RecordingError
from ..recording.runs.reader import Recording
from ..recording.runs.waveform import TimeSpan
from ..scene import Scene
from . import timeline
from .chart import Chart, Strip, send_labels, send_strips
from .layer import Layer
from .sensors import COLOUR, Shown, sensors_of

SIZE = (1040, 220)
WINDOW = 1.0  # [s], with a resolution of 1 Hz; longer if a sensor has too few samples in it
LONGER = 1.1  # times the length of the fewest samples, as their times are rounded
STEP, MOST = 0.5, 40  # [s] between windows, and windows of all detail
FEWEST = 256  # samples of a window
NAMED = 6  # highest lines with a name
DECADES = 4  # of amplitudes shown
PASSED = 0.4  # share of the sample rate that sensors pass
BAND = (0.2, PASSED)  # of the sample rate: the band whose envelope is shown
ENVELOPE = 1.5  # mesh frequencies shown of the spectrum of the envelope
_SHORT = 60  # characters of a name


class Kind(NamedTuple):
    """A chart of a sensor."""

    name: str
    title: str
    axis: str


KINDS = (
    Kind("spectrum", "Spectrum", "Frequency [Hz]"),
    Kind("order_spectrum", "Order spectrum", "Cycles per turn of the sun relative to the carrier"),
    Kind("envelope_spectrum", "Spectrum of the squared envelope", "Frequency [Hz]"),
)


class _Windows(NamedTuple):
    """Windows of a sensor in one recording, drawn in its layer."""

    layer: Layer
    times: list[rr.TimeColumn]
    signals: list[Signal]
    scene: Scene | None
    """Of the gears of a twin, which names the lines; None: they have no names."""


def log_sensor_spectra(
    layers: Sequence[Layer],
    recordings: Sequence[Recording],
    shown: Shown,
    scene: Scene | None,
    detail: list[TimeSpan],
) -> Iterator[str]:
    """Log /sensors/NAME/spectrum, order_spectrum and envelope_spectrum; yield warnings.

    The lines of the first recording have names. Spectra of sensors of the same name in the others
    are beside them, in its unit.

    Args:
        layers: a layer for each recording.
        recordings: the first has the sensor.
        shown: the sensor.
        scene: of the gears; None: lines have no names.
        detail: time spans [s] of the windows.
    """
    windows = []
    for layer, recording in zip(layers, recordings, strict=True):
        for other in sensors_of(recording):
            if other.page.name != shown.page.name:
                continue
            unit, of = other.page.unit, recording.path
            if unit == shown.page.unit:
                windows.append(_windows(layer, recording, other, scene, detail))
            else:
                yield (
                    f"{of}: {other.page.name} is in {unit}, not in {shown.page.unit} as in the "
                    "first recording, so its spectra are not drawn"
                )
    for kind in KINDS:
        _log_chart(f"{shown.path}/{kind.name}", kind, [each for each in windows if each.signals])


def _windows(
    layer: Layer, recording: Recording, shown: Shown, scene: Scene | None, detail: list[TimeSpan]
) -> _Windows:
    begins = np.concatenate([np.arange(a, max(b - WINDOW, a) + 1e-9, STEP) for a, b in detail])
    begins = begins[:: math.ceil(len(begins) / MOST)]
    signals = [one for begin in begins if (one := _window(recording, shown, begin)) is not None]
    middles = np.array([signal.time.mean() for signal in signals])
    first = recording.state.stamp[0]
    stamps = np.interp(middles, recording.state.time, recording.state.stamp - first)
    times = timeline.columns(middles, first + np.rint(stamps).astype(np.int64))
    return _Windows(layer, times, signals, scene if shown.page.of_twin else None)


def _window(recording: Recording, shown: Shown, begin: float) -> Signal | None:
    """The longest part without a gap of a window; None if it is too short."""
    sensor, number = shown.channel
    end = begin + max(WINDOW, LONGER * FEWEST / sensor.rate)
    found = sensor.samples(recording.to_time, begin, end)
    if len(found.time) < FEWEST:
        return None
    angle = (
        relative_angle(recording, found.time) if shown.page.of_twin else np.zeros(len(found.time))
    )
    values = found.values[:, number].astype(np.float64)
    try:
        part = Signal(values, found.time, angle, None).within(begin, end)
    except RecordingError:
        return None
    return part if len(part.time) >= FEWEST else None


def _spectrum(kind: Kind, signal: Signal, scene: Scene | None) -> MeshSpectrum | None:
    """A spectrum of a window; None if it has none, as while the shaft reverses."""
    teeth = None if scene is None else scene.gearset.teeth.sun
    rate = signal.sample_rate
    if kind.name == "envelope_spectrum":
        signal = squared_envelope(signal, Band(*(share * rate for share in BAND)))
    elif kind.name == "order_spectrum":
        try:
            return None if scene is None else order_spectrum_of(signal, teeth)
        except ValueError:  # at rest, or it reverses
            return None
    return frequency_spectrum_of(signal, teeth)


def _log_chart(path: str, kind: Kind, windows: list[_Windows]) -> None:
    found = [[_spectrum(kind, signal, each.scene) for signal in each.signals] for each in windows]
    known = [one for each in found for one in each if one is not None]
    highest = max((float(one.amplitude[1:].max()) for one in known), default=0.0)
    if highest <= 0.0:
        return
    top = 10.0 ** math.ceil(math.log10(highest))
    reach = max(_reach(kind, one) for one in known)
    limits = {"xlim": (0.0, reach), "ylim": (top * 10.0**-DECADES, top)}
    chart = Chart(path, SIZE, yscale="log", xlabel=kind.axis, **limits)
    chart.log(windows[0].layer)
    for each, spectra in zip(windows, found, strict=True):
        curves = [[] if one is None else [_curve(chart, one, reach)] for one in spectra]
        colour = each.layer.shade(COLOUR)
        send_strips(each.layer, f"{path}/curve", each.times, curves, colour)
    first, spectra = windows[0], found[0]
    labels = [[] if one is None else _names(chart, one, first.scene, reach) for one in spectra]
    send_labels(first.layer, f"{path}/names", first.times, labels)


def _reach(kind: Kind, found: MeshSpectrum) -> float:
    """End of the axis."""
    passed = PASSED * found.sample_rate
    if kind.name == "envelope_spectrum" and found.mesh is not None:
        return min(ENVELOPE * found.mesh, passed)
    return min(passed, found.band.high)


def _curve(chart: Chart, found: MeshSpectrum, reach: float) -> Strip:
    inside = slice(1, int(np.searchsorted(found.axis, reach, side="right")))
    return chart.place(found.axis[inside], found.amplitude[inside])


def _names(
    chart: Chart, found: MeshSpectrum, scene: Scene | None, reach: float
) -> list[tuple[Strip, str]]:
    """The highest lines with what causes them."""
    lines = LineNames(found.within(Band(0.0, reach)), scene, filtered=True).named(NAMED)
    return [
        (chart.place([one.line.place], [one.line.amplitude])[0], one.text[:_SHORT])
        for one in lines
        if one.text
    ]
