"""Spectrum of the DTE around the time cursor, and order map of the whole recording."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from ..analysis.aliases import NEGLIGIBLE, alias_remark, alias_share
from ..analysis.orders import order_spectrum
from ..analysis.signals import relative_angle
from ..analysis.spectrum import amplitude_spectrum
from ..scene import Scene
from ..simulation.natural_modes import natural_modes
from .chart import Chart, Ticks, log_frame, send_labels, send_strips, texts_at
from .colour_map import shade
from .frames import Frames
from .layer import Layer
from .plots import mesh_colours
from .round_numbers import ticks

Array = NDArray[np.float64]
WIDTH, HEIGHT = 940.0, 215.0
WINDOW, CYCLES = 0.2, 64  # [s], with a resolution of 5 Hz, or mesh cycles if slower
HARMONICS = 8  # mesh harmonics shown
MARKS = 24  # mesh harmonics marked in a spectrum at most
DECADES = 4  # of amplitudes shown
_MICRO = 1e6
_FEWEST_TURNS = 2.0  # of the sun in a window of the order map
_MESH_MARK = (104, 82, 40)
_LABEL_WIDTH = 36.0
_BARS = 48  # steps of the drawn scale
_CURSOR = (235, 235, 235)
_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def log_spectra(layer: Layer, frames: Frames, scene: Scene | None) -> str | None:
    """Log /spectrum and, with a scene, /order_map.

    Args:
        layer: recording to draw into.
        frames: windows of the DTE.
        scene: gives the tooth numbers for orders.

    Returns:
        A warning if the sample rate is too low for the signal, else None.
    """
    spectra = [_spectrum(frames, number) for number in range(len(frames.time))]
    highest = max((a[1:].max() for _, a in spectra if len(a) > 1), default=0.0)
    if highest <= 0.0:
        return None
    top = math.ceil(math.log10(highest))
    _log_spectrum(layer, frames, spectra, top)
    if scene is not None:
        _log_order_map(layer, frames, scene.gearset.teeth.sun, top)
    return _alias_remark(frames, spectra, scene)


def _alias_remark(
    frames: Frames, spectra: list[tuple[Array, Array]], scene: Scene | None
) -> str | None:
    """Warning about the window with the largest aliasing, or None."""
    shares = np.array([alias_share(*spectrum) if len(spectrum[0]) else 0.0 for spectrum in spectra])
    worst = int(np.argmax(shares))
    if shares[worst] <= NEGLIGIBLE:
        return None
    highest = None if scene is None else float(natural_modes(scene).frequencies.max())
    mesh, rate = float(frames.state("mesh_frequency")[worst]), 2.0 * float(spectra[worst][0][-1])
    known = mesh if mesh > 0.0 else None
    remark = alias_remark(rate, float(shares[worst]), highest, known)
    return f"spectrum around {frames.time[worst]:.2f} s: {remark}"


def _spectrum(frames: Frames, number: int) -> tuple[Array, Array]:
    """Frequencies [Hz] and amplitudes [um] of a window; empty if samples are missing."""
    window = frames.window(number, frames.lasting(WINDOW, CYCLES))
    if window is None:
        return np.empty(0), np.empty(0)
    time, dte = window
    rate = (len(time) - 1) / (time[-1] - time[0])
    return amplitude_spectrum(_MICRO * dte, rate)


def _log_spectrum(
    layer: Layer, frames: Frames, spectra: list[tuple[Array, Array]], top: int
) -> None:
    mesh = frames.state("mesh_frequency")
    nyquist = max(frequency[-1] for frequency, _ in spectra if len(frequency))
    reach = min(nyquist, HARMONICS * float(np.nanmax(mesh, initial=0.0)) * 1.02 or nyquist)
    chart = Chart("spectrum", WIDTH, HEIGHT, (0.0, reach), (top - DECADES, top))
    marks = ticks(0.0, reach, 8)
    log_frame(
        layer,
        chart,
        Ticks(marks, [f"{mark:g}" for mark in marks]),
        _decades(top),
        "Frequency [Hz]",
    )
    curves = []
    for frequency, amplitude in spectra:
        shown = slice(1, int(np.searchsorted(frequency, reach, side="right")))
        level = np.log10(np.maximum(amplitude[shown], 1e-30))
        curves.append([chart.place(frequency[shown], level)] if len(level) else [])
    colour = mesh_colours(frames.recording.planets)[0]
    send_strips(layer, "spectrum/dte", frames.index, curves, {"colors": [colour], "radii": [0.6]})
    style = {"colors": [_MESH_MARK], "radii": [0.4], "draw_order": -5.0}
    marked = [_harmonics(chart, f) if curve else [] for f, curve in zip(mesh, curves, strict=True)]
    lines = [[chart.upright(at) for at, _ in row] for row in marked]
    send_strips(layer, "spectrum/mesh_harmonics", frames.index, lines, style)
    texts = [
        (np.array([chart.upright(at)[1] - (0.0, 24.0) for at, text in row if text], np.float32),
         [text for _, text in row if text])
        for row in marked
    ]  # fmt: skip
    send_labels(layer, "spectrum/mesh_orders", frames.index, texts)


def _harmonics(chart: Chart, mesh: float) -> list[tuple[float, str]]:
    """Frequencies [Hz] of the mesh harmonics shown; only some have a text, to avoid overlap."""
    if not mesh > 0.0:
        return []
    apart = chart.width * mesh / chart.x[1]
    every = math.ceil(_LABEL_WIDTH / apart)
    count = min(int(chart.x[1] / mesh), MARKS)
    return [(h * mesh, "" if h % every else f"{h}×") for h in range(1, count + 1)]


def _log_order_map(layer: Layer, frames: Frames, teeth: int, top: int) -> None:
    """Log an image with a column per window, and its colour bar."""
    reach = (HARMONICS + 0.5) * teeth
    chart = Chart("order_map", WIDTH, HEIGHT, (frames.time[0], frames.time[-1]), (0.0, reach))
    levels = np.column_stack([_orders(frames, number, reach) for number in range(len(frames.time))])
    colours = shade((np.log10(np.fmax(levels, 1e-30)) - top) / DECADES + 1.0)
    colours[np.isnan(levels)] = 0
    nearest = np.rint(np.linspace(0, len(frames.time) - 1, int(WIDTH))).astype(np.intp)
    image = np.ascontiguousarray(colours[::-1, nearest])
    layer.log("order_map/image", rr.Transform3D(translation=(0.0, -HEIGHT, 0.0)), static=True)
    layer.log("order_map/image", rr.Image(image, draw_order=-20.0), static=True)
    marks, orders = ticks(*chart.x, 12), [float(teeth * h) for h in range(1, HARMONICS + 1)]
    x = Ticks(marks, [f"{mark:g}" for mark in marks])
    y = Ticks(orders, [f"{h}× {order:g}" for h, order in enumerate(orders, start=1)])
    log_frame(layer, chart, x, y, "Simulated time [s]")
    _log_scale(layer, chart, top)
    cursor = [[chart.upright(time)] for time in frames.time]
    style = {"colors": [_CURSOR], "radii": [0.6]}
    send_strips(layer, "order_map/cursor", frames.index, cursor, style)


def _log_scale(layer: Layer, chart: Chart, top: int) -> None:
    """Colour bar above the map, with the amplitudes of its ends."""
    left, right, y = chart.width - 240.0, chart.width - 90.0, -chart.height - 14.0
    edges = np.linspace(left, right, _BARS + 1)
    bars = [np.array([(a, y), (b, y)], np.float32) for a, b in pairwise(edges)]
    colours = shade((np.arange(_BARS) + 0.5) / _BARS)
    bar = rr.LineStrips2D(bars, colors=colours, radii=4.0)
    layer.log("order_map/scale", bar, static=True)
    ends = _decades(top).texts[0], f"{_decades(top).texts[-1]} µm"
    places = np.array([(left - 28.0, y - 12.0), (right + 38.0, y - 12.0)], np.float32)
    layer.log("order_map/amplitudes", texts_at(places, ends), static=True)


def _orders(frames: Frames, number: int, reach: float) -> Array:
    """Largest amplitude [um] in each row of the image; NaN where it is unknown."""
    rows = int(HEIGHT)
    window = frames.window(number, frames.lasting(WINDOW, CYCLES))
    if window is None:
        return np.full(rows, np.nan)
    time, dte = window
    angle = relative_angle(frames.recording, time)
    if abs(angle[-1] - angle[0]) < _FEWEST_TURNS * 2.0 * math.pi:
        return np.full(rows, np.nan)
    order, amplitude = order_spectrum(_MICRO * dte, angle, math.ceil(2.5 * reach))
    levels = np.zeros(rows)
    row = np.minimum((order / reach * rows).astype(np.intp), rows)[1:]
    np.maximum.at(levels, row[row < rows], amplitude[1:][row < rows])
    half_rate = math.pi * (len(time) - 1) / abs(angle[-1] - angle[0])  # as an order
    levels[math.ceil(half_rate / reach * rows) :] = np.nan
    return levels


def _decades(top: int) -> Ticks:
    exponents = range(top - DECADES, top + 1)
    return Ticks(exponents, [f"10{str(e).translate(_SUPERSCRIPT)}" for e in exponents])
