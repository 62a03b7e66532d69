"""Table 5, Figures 13 and 14: natural frequencies and modes against the sun mesh stiffness."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from matplotlib.figure import Figure
from scipy.optimize import brentq

from planetary_twin_py.modal.modes import NaturalModes, clusters, modes_of
from planetary_twin_py.modal.natural import natural_modes, spring_model
from planetary_twin_py.modal.printed import (
    EQUATION_37,
    FITTED_TO_TABLE_5,
    PrintedSet,
    printed_model,
)
from planetary_twin_py.plots.style import BLUE, CYCLE, GREY, ORANGE, panels
from planetary_twin_py.scene import Scene

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import agrees, rises

TABLE_5 = (0, 3687, 5956, 10070, 10070, 11948)  # [Hz]
MESH_STIFFNESS = 2e8  # [N/m] Table 4
RING_OF_TABLE_4 = 0.779  # [kg]; (37) has 0.759
WITHIN = 0.01  # relative difference up to which a frequency agrees with the paper
PRINTED_RANGE = (1.5e3, 1.5e4)  # [N/m] section 9.1
CAPTION_STIFFNESS = (1.4e3, 1.5e4)  # [N/m] Figure 14
CAPTION_FREQUENCIES = (23.0, 8643.0)  # [Hz]
UNIT_SLIP = 1e3  # factor of a stiffness in N/mm that is read as N/m
MESHING_FREQUENCY = 350.0  # [Hz] section 9.1
SAME_SHAPE = 0.9  # modal assurance criterion above which shapes count as equal


def printed_modes(
    sun_planet_stiffness: float = MESH_STIFFNESS, data: PrintedSet = EQUATION_37
) -> NaturalModes:
    """Modes of (37) and (38).

    Args:
        sun_planet_stiffness: of the sun-planet meshes [N/m].
        data: the other values.

    Returns:
        The modes.
    """
    return modes_of(printed_model(data._replace(sun_planet=sun_planet_stiffness)))


def natural_frequencies(evidence: Evidence) -> Entry:
    """Table 5."""
    twin = natural_modes(evidence.scene).frequencies
    literal = printed_modes().frequencies
    fitted = printed_modes(data=FITTED_TO_TABLE_5).frequencies
    table_4 = printed_modes(data=EQUATION_37._replace(ring=RING_OF_TABLE_4)).frequencies
    held = np.append(twin, np.nan)[: len(TABLE_5)]
    support = EQUATION_37.carrier_support
    carrier = (support / EQUATION_37.carrier) ** 0.5 / (2.0 * np.pi)
    return Entry(
        number="Table 5",
        title="natural frequencies",
        claims=(
            Claim(
                says=f"{_list(TABLE_5)} Hz from (37) and (38)",
                ours=f"{_list(twin)} Hz (carrier held)",
                printed=f"{_list(literal)} Hz",
                holds=agrees(held[1:], TABLE_5[1:], WITHIN),
                printed_holds=agrees(literal[1:], TABLE_5[1:], WITHIN),
                kind="number",
                why="in (38) the stiffness along the line of action acts on the pitch circles, and "
                f"{carrier:.0f} Hz is the frequency of the carrier on a separate spring of "
                f"{support:g} N/m, which a held carrier does not have",
            ),
            Claim(
                says="the same frequencies to the last digit",
                ours="-",
                holds=False,
                printed=f"differences of up to {_largest_error(literal)}, with "
                f"{RING_OF_TABLE_4:g} kg for the ring up to {_largest_error(table_4)}",
                printed_holds=agrees(np.round(literal), TABLE_5)
                or agrees(np.round(table_4), TABLE_5),
                kind="number",
                why=f"Table 5 follows neither from the {EQUATION_37.ring:g} kg of (37) nor from "
                f"the {RING_OF_TABLE_4:g} kg of Table 4 for the ring",
            ),
        ),
        remarks=f"Frequencies agree if they differ by at most {WITHIN:.0%}. Masses of "
        f"{'/'.join(f'{mass:g}' for mass in FITTED_TO_TABLE_5[:4])} kg (sun/planet/ring/carrier) "
        f"give {_list(np.floor(fitted))} Hz, truncated to integers. These masses are fitted, and "
        "four masses can be fitted to any four frequencies of this order, so this is no evidence "
        "of the values that the authors used.",
        figures={"twin": twin, "literal": literal, "table_4": table_4, "fitted": fitted},
    )


def _largest_error(frequencies: np.ndarray) -> str:
    return f"{100.0 * np.abs(frequencies[1:] / TABLE_5[1:] - 1.0).max():.2f} %"


def _list(values: object) -> str:
    return ", ".join(f"{value:.0f}" for value in np.asarray(values))


def against_stiffness(evidence: Evidence) -> Entry:
    """Figure 13."""
    span = np.geomspace(*PRINTED_RANGE, 41)
    low = np.array([printed_modes(k).frequencies[1] for k in span])
    twin = np.array([_twin_at(evidence.scene, k).frequencies[1] for k in span])
    crossing = _stiffness_at(MESHING_FREQUENCY, lambda k: float(printed_modes(k).frequencies[1]))
    ours = _stiffness_at(
        MESHING_FREQUENCY, lambda k: float(_twin_at(evidence.scene, k).frequencies[1])
    )
    crosses = bool(low[0] <= MESHING_FREQUENCY <= low[-1])
    twin_crosses = bool(twin[0] <= MESHING_FREQUENCY <= twin[-1])
    return Entry(
        number="Figure 13",
        title="eigenfrequencies against Ksp",
        claims=(
            Claim(
                says="eigenfrequencies change as Ksp increases from 1.5e3 to 1.5e4 N/m",
                ours=f"the second increases from {twin[0]:.1f} to {twin[-1]:.1f} Hz",
                printed=f"from {low[0]:.2f} to {low[-1]:.2f} Hz",
                holds=rises(twin),
                printed_holds=rises(low),
                why="the second eigenfrequency does not increase with Ksp",
            ),
            Claim(
                says="one of them may coincide with the mesh frequency of 350 Hz",
                ours=f"at Ksp = {ours:.3g} N/m",
                printed=f"at Ksp = {crossing:.3g} N/m",
                holds=twin_crosses,
                printed_holds=crosses,
                kind="number",
                why=f"within the printed range the second eigenfrequency stays below "
                f"{low[-1]:.0f} Hz; it is 350 Hz at {crossing:.3g} N/m",
            ),
        ),
        remarks="In this range only the second eigenfrequency changes. It is proportional to the "
        "root of Ksp, because only the sun moves on a soft mesh. The text of the paper does not "
        'say which curves are "planet 1" and "ring". The stiffness of the ring meshes is 2e8 N/m.',
        picture=_draw_frequencies(evidence.scene),
        figures={"crossing_printed": crossing, "crossing": ours},
    )


def _twin_at(scene: Scene, stiffness: float) -> NaturalModes:
    return natural_modes(scene.replace(**{"mesh.sun_planet_stiffness": stiffness}))


def _stiffness_at(frequency: float, mode: Callable[[float], float]) -> float:
    """Ksp [N/m] at which a mode has `frequency` [Hz]."""
    root = brentq(lambda power: mode(10.0**power) - frequency, 3.0, 10.0)
    return float(10.0**root)


def _draw_frequencies(scene: Scene) -> Figure:
    figure, (printed, wide) = panels(2, 3.1)
    span = np.geomspace(*PRINTED_RANGE, 60)
    lowest = [printed_modes(k).frequencies[1] for k in span]
    twin = [_twin_at(scene, k).frequencies[1] for k in span]
    printed.plot(1e-3 * span, lowest, color=ORANGE, label="(37), (38)")
    printed.plot(1e-3 * span, twin, color=BLUE, ls="--", label="twin, carrier held")
    printed.set_title("second mode in the printed range")
    printed.set_xlabel("Ksp [1e3 N/m]")
    printed.set_ylabel("natural frequency [Hz]")
    printed.set_ylim(0, None)
    printed.legend()
    span = np.geomspace(1e3, 1e9, 160)
    found = np.array([printed_modes(k).frequencies[1:] for k in span])
    wide.loglog(span, found, color=ORANGE, lw=1.2)
    wide.axvspan(*PRINTED_RANGE, color=GREY, alpha=0.2, lw=0)
    for frequency in (MESHING_FREQUENCY, CAPTION_FREQUENCIES[1]):
        wide.axhline(frequency, color=BLUE, lw=0.9, ls=":")
        wide.annotate(
            f"{frequency:.0f} Hz", (1.1e9, frequency), va="center", color=BLUE, fontsize=8.5,
            annotation_clip=False,
        )  # fmt: skip
    wide.set_title("all modes of (37), (38); printed range shaded")
    wide.set_xlabel("Ksp [N/m]")
    wide.set_xlim(1e3, 1e9)
    return figure


def mode_shapes(evidence: Evidence) -> Entry:
    """Figure 14."""
    soft, stiff = (printed_modes(k) for k in CAPTION_STIFFNESS)
    text = float(printed_modes(PRINTED_RANGE[0]).frequencies[1])
    highest = float(stiff.frequencies[-1])
    where = _stiffness_at(CAPTION_FREQUENCIES[1], _highest)
    slip = UNIT_SLIP * CAPTION_STIFFNESS[1]
    slipped, fitted = _highest(slip), _highest(slip, FITTED_TO_TABLE_5)
    mass = printed_model(EQUATION_37).mass
    similarity = _similarity(soft, stiff, mass)
    far = _similarity(soft, printed_modes(MESH_STIFFNESS), mass)
    ours = [_twin_at(evidence.scene, k) for k in CAPTION_STIFFNESS]
    own = _similarity(ours[0], ours[1], spring_model(evidence.scene).mass)
    low = float(ours[0].frequencies[1])
    return Entry(
        number="Figure 14",
        title="eigenmodes at two stiffnesses",
        claims=(
            Claim(
                says="23 Hz at the low end of Ksp, 1.5e3 N/m in the text, 1.4e3 in the caption",
                ours=f"{low:.1f} Hz at 1.4e3 N/m",
                holds=round(low) == CAPTION_FREQUENCIES[0],
                printed=f"{text:.2f} Hz at 1.5e3, {soft.frequencies[1]:.2f} Hz at 1.4e3 N/m",
                printed_holds=round(text) == CAPTION_FREQUENCIES[0],
                kind="number",
            ),
            Claim(
                says="8643 Hz at Ksp = 1.5e4 N/m",
                ours=f"highest mode {ours[1].frequencies[-1]:.0f} Hz",
                holds=agrees(ours[1].frequencies[-1], CAPTION_FREQUENCIES[1], 1e-3),
                printed=f"highest mode {highest:.0f} Hz",
                printed_holds=agrees(highest, CAPTION_FREQUENCIES[1], 1e-3),
                kind="number",
                why=f"8643 Hz requires Ksp = {where:.3g} N/m, "
                f"{where / CAPTION_STIFFNESS[1]:.0f} times the stated value; a factor of exactly "
                f"{UNIT_SLIP:.0f}, from N/mm read as N/m, gives {slipped:.0f} Hz "
                f"({_off(slipped)}), and with the masses fitted to Table 5 {fitted:.0f} Hz "
                f"({_off(fitted)})",
            ),
            Claim(
                says="the modes change drastically as Ksp varies",
                ours=f"modal assurance criterion of the least similar shapes at 1.4e3 and 1.5e4 "
                f"N/m: {own:.3f}",
                holds=own < SAME_SHAPE,
                printed=f"{similarity:.3f}; at 1.4e3 and 2e8 N/m: {far:.2f}",
                printed_holds=similarity < SAME_SHAPE,
                why="in the printed range the shapes do not change; they change when the sun mesh "
                "is as stiff as the ring mesh",
            ),
        ),
        remarks="The drawings of the paper were not available. The two modes with equal "
        "frequencies, in which planets move relative to each other, are compared as a plane.",
        picture=_draw_shapes(),
        figures={
            "highest_mode": highest,
            "stiffness_at_8643_hz": where,
            "highest_mode_at_slip": slipped,
            "highest_mode_at_slip_fitted": fitted,
        },
    )


def _highest(stiffness: float, data: PrintedSet = EQUATION_37) -> float:
    """Highest natural frequency of (37) and (38) [Hz] at a sun-planet stiffness [N/m]."""
    return float(printed_modes(stiffness, data).frequencies[-1])


def _off(frequency: float) -> str:
    """Relative difference of a frequency [Hz] from the higher one of the caption."""
    return f"{100 * (frequency / CAPTION_FREQUENCIES[1] - 1):+.2f} %"


def _similarity(first: NaturalModes, second: NaturalModes, mass: np.ndarray) -> float:
    """Smallest of the best modal assurance criteria of the shapes of two sets.

    Shapes with equal frequencies in `second` are compared as a subspace, because every linear
    combination of them is a shape.
    """
    overlap = (first.shapes.T @ (mass[:, None] * second.shapes)) ** 2
    together = [overlap[:, same].sum(axis=1) for same in clusters(second.frequencies)]
    return float(np.max(together, axis=0).min())


def _draw_shapes() -> Figure:
    figure, axes = panels(2, 3.0)
    for place, stiffness in zip(axes, CAPTION_STIFFNESS, strict=True):
        modes = printed_modes(stiffness)
        names = [name.removesuffix(".u").replace("_", "\n") for name in modes.coordinates]
        for colour, mode in zip(CYCLE, (1, len(names) - 1), strict=False):
            shape = modes.shapes[:, mode] / np.abs(modes.shapes[:, mode]).max()
            shape *= np.sign(shape[np.abs(shape).argmax()])
            offset = -0.18 if mode == 1 else 0.18
            place.bar(
                np.arange(len(names)) + offset, shape, 0.34, color=colour,
                label=f"{modes.frequencies[mode]:.1f} Hz",
            )  # fmt: skip
        place.axhline(0, color="black", lw=0.7)
        place.set_xticks(range(len(names)), names)
        place.set_title(f"(37), (38) with Ksp = {stiffness:g} N/m")
        place.set_ylim(-0.5, 1.35)
        place.legend(loc="upper right", ncols=2)
    axes[0].set_ylabel("motion r θ, largest 1")
    return figure
