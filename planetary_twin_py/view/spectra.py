"""Spectrum of the DTE around the time cursor, and order map of the whole recording."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.colors import LogNorm
from numpy.typing import NDArray

from ..analysis.sampling.aliases import NEGLIGIBLE, alias_remark, alias_share
from ..analysis.shaft.orders import order_spectrum
from ..analysis.signals.signal import relative_angle
from ..analysis.spectra.spectrum import amplitude_spectrum
from ..scene import Scene
from ..simulation.natural_modes import natural_modes
from .chart import SHADES, Chart, dark, send_labels, send_strips
from .frames import Frames
from .layer import Layer
from .plots import mesh_colours

Array = NDArray[np.float64]
SIZE = (1040, 300)
WINDOW, CYCLES = 0.2, 64  # [s], with a resolution of 5 Hz, or mesh cycles if slower
HARMONICS = 8  # mesh harmonics shown
MARKS = 24  # mesh harmonics marked in a spectrum at most
DECADES = 4  # of amplitudes shown
ROWS = 240  # of the order map
_MICRO = 1e6
_FEWEST_TURNS = 2.0  # of the sun in a window of the order map
_MESH_MARK = (104, 82, 40)
_LABEL_WIDTH = 36.0  # [pixels of the screen]
_CURSOR = (235, 235, 235)


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
    top = 10.0 ** math.ceil(math.log10(highest))
    shown = top * 10.0**-DECADES, top
    _log_spectrum(layer, frames, spectra, shown)
    if scene is not None:
        _log_order_map(layer, frames, scene.gearset.teeth.sun, shown)
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
    layer: Layer,
    frames: Frames,
    spectra: list[tuple[Array, Array]],
    amplitudes: tuple[float, float],
) -> None:
    mesh = frames.state("mesh_frequency")
    nyquist = max(frequency[-1] for frequency, _ in spectra if len(frequency))
    reach = min(nyquist, HARMONICS * float(np.nanmax(mesh, initial=0.0)) * 1.02 or nyquist)
    chart = Chart(
        "spectrum", SIZE, yscale="log", xlim=(0.0, reach), ylim=amplitudes, xlabel="Frequency [Hz]"
    )
    chart.log(layer)
    curves, marked = [], []
    for (frequency, amplitude), passing in zip(spectra, mesh, strict=True):
        shown = slice(1, int(np.searchsorted(frequency, reach, side="right")))
        curve = chart.place(frequency[shown], amplitude[shown])
        curves.append([curve] if len(curve) else [])
        marked.append(_harmonics(passing, reach) if len(curve) else [])
    lines = [[chart.upright(at) for at, _ in row] for row in marked]
    texts = [[(chart.upright(at)[1], text) for at, text in row if text] for row in marked]
    colour = mesh_colours(frames.recording.planets)[0]
    send_strips(layer, "spectrum/mesh_harmonics", frames.index, lines, _MESH_MARK, 0.8)
    send_strips(layer, "spectrum/dte", frames.index, curves, colour)
    send_labels(layer, "spectrum/mesh_orders", frames.index, texts)


def _harmonics(mesh: float, reach: float) -> list[tuple[float, str]]:
    """Frequencies [Hz] of the mesh harmonics shown; only some have a text, to avoid overlap."""
    if not mesh > 0.0:
        return []
    every = math.ceil(_LABEL_WIDTH * reach / (SIZE[0] * mesh))
    count = min(int(reach / mesh), MARKS)
    return [(h * mesh, "" if h % every else f"{h}×") for h in range(1, count + 1)]


def _log_order_map(
    layer: Layer, frames: Frames, teeth: int, amplitudes: tuple[float, float]
) -> None:
    """Log a map with a column per window, and a line at the time cursor."""
    reach, (first, last) = (HARMONICS + 0.5) * teeth, frames.time[[0, -1]]
    levels = np.column_stack([_orders(frames, number, reach) for number in range(len(frames.time))])
    orders = {f"{h}× {teeth * h}": teeth * h for h in range(1, HARMONICS + 1)}
    chart = Chart("order_map", SIZE, xlabel="Simulated time [s]")
    image = chart.axes.imshow(
        np.maximum(levels, amplitudes[0]),
        cmap=SHADES,
        norm=LogNorm(*amplitudes),
        origin="lower",
        aspect="auto",
        extent=(first, last, 0.0, reach),
    )
    chart.axes.set_yticks([*orders.values()], [*orders])
    chart.axes.grid(visible=False)
    with dark():
        chart.figure.colorbar(image, label="µm")
    chart.log(layer)
    cursor = [[chart.upright(time)] for time in frames.time]
    send_strips(layer, "order_map/cursor", frames.index, cursor, _CURSOR)


def _orders(frames: Frames, number: int, reach: float) -> Array:
    """Largest amplitude [um] in each row of the map; NaN where it is unknown."""
    window = frames.window(number, frames.lasting(WINDOW, CYCLES))
    if window is None:
        return np.full(ROWS, np.nan)
    time, dte = window
    angle = relative_angle(frames.recording, time)
    if abs(angle[-1] - angle[0]) < _FEWEST_TURNS * 2.0 * math.pi:
        return np.full(ROWS, np.nan)
    order, amplitude = order_spectrum(_MICRO * dte, angle, math.ceil(2.5 * reach))
    levels = np.zeros(ROWS)
    row = np.minimum((order / reach * ROWS).astype(np.intp), ROWS)[1:]
    np.maximum.at(levels, row[row < ROWS], amplitude[1:][row < ROWS])
    half_rate = math.pi * (len(time) - 1) / abs(angle[-1] - angle[0])  # as an order
    levels[math.ceil(half_rate / reach * ROWS) :] = np.nan
    return levels
