"""Recognises a vibration whose mesh harmonics are elsewhere than those of its scene.

Another speed, another held member or another unit of the time multiplies all frequencies by one
factor. Other sources, such as the harmonics of the mains, are at no such factor: one is reported
only if it explains most of the vibration, and if it is near 1, is that of another held member,
explains sidebands of the gears as well, or a series of harmonics with all that the scene explains.

Harmonics alone do not determine an integer factor: those of twice the mesh frequency are its even
harmonics. Their sidebands do, because their distance is that of the turns of a gear.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Set
from typing import NamedTuple

from ...gearset.kinematics import MEMBERS
from ...scene import Scene
from ..shaft.orders import mesh_order
from ..spectra.spectrum import Line, strongest_lines
from .distinct_lines import DISTINCT, over_noise
from .mesh_spectrum import MeshSpectrum
from .sidebands import Sidebands

LINES = 12  # highest lines that are compared, if they are distinct
HARMONICS = 8  # of another mesh frequency
MOST_OF = 0.5  # share of the sum of the squared amplitudes of these lines
EXACT = 0.5  # [bins] largest distance of a line from its harmonic, as places are interpolated
FEWEST = 2  # explained lines
SERIES = 3  # harmonics that are evidence without sidebands
_ROUNDING = 1e-9  # by which a mesh frequency at half the sample rate may seem to be above it
CLOSE = 0.1  # deviation of a factor from 1 that another speed explains


class Fit(NamedTuple):
    """Lines that a mesh frequency explains."""

    factor: float
    """The mesh frequency over that of the scene."""
    held: str | None
    """Member that is held if that explains the factor."""
    harmonics: frozenset[int]
    """Numbers of the harmonics at lines."""
    explained: frozenset[Line]
    """Lines at harmonics and their sidebands."""
    pair: bool
    """Whether some are a pair of first sidebands, of one planet or of all."""

    @property
    def every(self) -> int:
        """Number of which all harmonics are multiples; 0 without a harmonic."""
        return math.gcd(*self.harmonics)

    @property
    def known(self) -> bool:
        """Whether another speed or another held member explains the factor."""
        return self.held is not None or abs(self.factor - 1.0) <= CLOSE


def scale_remarks(spectrum: MeshSpectrum, scene: Scene) -> Iterator[str]:
    """A line if mesh harmonics are above half the sample rate, or elsewhere than expected.

    Args:
        spectrum: of a measured vibration.
        scene: the gears.
    """
    if spectrum.mesh is None:
        return
    if spectrum.mesh > 0.5 * spectrum.sample_rate * (1.0 + _ROUNDING):
        yield (
            f"the mesh frequency of the scene is {2.0 * spectrum.mesh / spectrum.sample_rate:.3g} "
            "times half the sample rate, so no mesh harmonic is seen: is the unit of the time "
            "right? The heading of a time in milliseconds must be time [ms]"
        )
        return
    lines, own, others = _fits(spectrum, scene)
    if others and not own.harmonics:
        yield _report(others) + _others(others[1:])
    elif others and _better(others[0], own):
        yield _report(others) + _own(own, len(lines))
    elif len(own.explained) >= FEWEST and own.every > 1:
        yield (
            f"all mesh harmonics at the strongest lines are multiples of {own.every}: these fit a "
            f"mesh frequency {own.every} times that of the scene as well, unless the phases of the "
            "planets cancel the others: is the speed (input_speed) right?"
        )


def _report(fits: list[Fit]) -> str:
    cause = (
        "are the speed (input_speed), the teeth and the unit of the time right?"
        if fits[0].held is None
        else f"is gearset.held = {fits[0].held}?"
    )
    return (
        f"the strongest lines fit a mesh frequency {fits[0].factor:.4g} times that of the scene: "
        f"{cause} Lines are named by that of the scene."
    )


def _others(fits: list[Fit]) -> str:
    """Other factors that explain as much."""
    factors = " or ".join(f"{fit.factor:.4g}" for fit in fits)
    return f" They fit {factors} times that of the scene as well." if fits else ""


def _own(own: Fit, lines: int) -> str:
    """What the scene explains."""
    less = " without first sidebands" if len(own.explained) == lines else ""
    return f" The scene explains {len(own.explained)} of the {lines} highest lines{less}."


def _better(fit: Fit, own: Fit) -> bool:
    """Whether a mesh frequency explains more than that of the scene."""
    return (len(fit.explained), fit.pair) > (len(own.explained), own.pair)


def _fits(spectrum: MeshSpectrum, scene: Scene) -> tuple[list[Line], Fit, list[Fit]]:
    """The distinct lines, also outside of the band, and what explains them.

    Returns:
        The lines, the fit of the mesh frequency of the scene, and those of other frequencies that
        explain most lines. The first is that whose harmonics have no common divisor, or else
        nearest to 1; there are no others if another speed or held member explains it.
    """
    highest = strongest_lines(spectrum.axis, spectrum.amplitude, LINES)
    ratios = over_noise(spectrum.axis, spectrum.amplitude, highest, spectrum.error)
    lines = [line for line, ratio in zip(highest, ratios, strict=True) if ratio >= DISTINCT]
    assert spectrum.mesh is not None
    step, sidebands, held = float(spectrum.axis[1]), Sidebands.of(scene), _held_factors(scene)
    first = {1, scene.gearset.planets}
    many = math.ceil(spectrum.axis[-1] / spectrum.mesh)
    exact = EXACT * step / spectrum.mesh
    # A tooth of a planet meshes twice a turn. At another mesh frequency that would be no evidence:
    # sidebands twice as far apart are also the first ones of half that frequency.
    own = _fit(lines, spectrum.mesh, exact, sidebands, {"planet": {2, *first}}, first, many)
    found = []
    for harmonic in range(1, HARMONICS + 1 if lines else 1):
        mesh = lines[0].place / harmonic
        factor, near = mesh / spectrum.mesh, step / mesh
        if abs(lines[0].place - harmonic * spectrum.mesh) <= EXACT * step:
            continue  # that of the scene
        fit = _fit(lines, mesh, near, sidebands, {}, first, HARMONICS)
        cause = next((m for m, f in held.items() if abs(f / factor - 1.0) <= near), None)
        fit = fit._replace(factor=factor, held=cause)
        if _certain(fit, own, lines):
            found.append(fit)
    most = max((len(fit.explained) for fit in found), default=0)
    best = [fit for fit in found if len(fit.explained) == most]
    best.sort(key=lambda fit: (not fit.known, fit.every, max(fit.factor, 1.0 / fit.factor)))
    return lines, own, best[:1] if best and best[0].known else best


def _fit(
    lines: list[Line],
    mesh: float,
    near: float,
    sidebands: Sidebands,
    of_member: Mapping[str, Set[int]],
    first: Set[int],
    most: int,
) -> Fit:
    """Lines at the harmonics of a mesh frequency up to number `most`, and at their sidebands.

    Args:
        lines: of a spectrum.
        mesh: mesh frequency, on the axis of the spectrum.
        near: largest distance of a line from its harmonic [mesh orders].
        sidebands: of the gearbox.
        of_member: numbers of the sidebands that are evidence in a pair, by member.
        first: those of the other members: of one planet and of all.
        most: largest number of a harmonic.
    """
    orders = {line: line.place / mesh for line in lines}
    harmonics = {
        line: round(order)
        for line, order in orders.items()
        if 1 <= round(order) <= most and abs(order - round(order)) <= near
    }
    separate = sidebands.resolved(near)
    beside = {line: separate.at(order, near) for line, order in orders.items()}
    every = {sideband for found in beside.values() for sideband in found}
    pair = any(
        abs(one.number) in of_member.get(one.member, first)
        and one._replace(number=-one.number) in every
        for one in every
    )
    explained = harmonics.keys() | {line for line, found in beside.items() if found}
    return Fit(1.0, None, frozenset(harmonics.values()), frozenset(explained), pair)


def _certain(fit: Fit, own: Fit, lines: list[Line]) -> bool:
    """Whether most of the vibration is explained, with evidence that it is that of the gears."""
    energy = sum(line.amplitude**2 for line in fit.explained)
    most = energy > MOST_OF * sum(line.amplitude**2 for line in lines)
    shared = own.harmonics and own.explained <= fit.explained
    series = shared and len(fit.harmonics) >= SERIES and fit.every == 1
    evidence = fit.known or fit.pair or series
    return bool(most and len(fit.explained) >= FEWEST and evidence)


def _held_factors(scene: Scene) -> Mapping[str, float]:
    """Mesh frequency with another held member over that of the scene, at the same input speed."""
    teeth, member = scene.gearset.tooth_numbers, scene.drive.input.member
    if scene.drive.second_input is not None:
        return {}
    own = mesh_order(teeth, scene.gearset.held, member)
    return {
        held: float(mesh_order(teeth, held, member) / own)
        for held in MEMBERS
        if held not in (member, scene.gearset.held)
    }
