"""Recognises a vibration whose mesh harmonics are elsewhere than those of its scene.

Another speed, another held member or another unit of the time multiplies all frequencies by one
factor. Other sources, such as the harmonics of the mains, are at no such factor: one is reported
only if it explains most of the vibration, and if it is near 1, is that of another held member, or
explains sidebands of the gears as well.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from ..gearset.kinematics import MEMBERS
from ..scene import Scene
from .mesh_spectrum import MeshSpectrum
from .orders import mesh_order
from .sidebands import Sidebands
from .spectrum import Line, strongest_lines

LINES = 12  # highest lines that are compared
HARMONICS = 8  # of the mesh frequency
MOST_OF = 0.5  # share of the sum of the squared amplitudes of these lines
EXACT = 0.5  # [bins] largest distance of a line from its harmonic, as places are interpolated
FEWEST = 2  # explained lines
CLOSE = 0.1  # deviation of a factor from 1 that another speed explains


class Scale(NamedTuple):
    """Mesh frequency of a vibration over that of its scene."""

    factor: float
    held: str | None
    """Member that is held if that explains the factor."""


def scale_remarks(spectrum: MeshSpectrum, scene: Scene) -> Iterator[str]:
    """A line if mesh harmonics are above half the sample rate, or elsewhere than expected.

    Args:
        spectrum: of a measured vibration.
        scene: the gears.
    """
    if spectrum.mesh is None:
        return
    if spectrum.mesh > 0.5 * spectrum.sample_rate:
        yield (
            f"the mesh frequency of the scene is {2.0 * spectrum.mesh / spectrum.sample_rate:.3g} "
            "times half the sample rate, so no mesh harmonic is seen: is the unit of the time "
            "right? The heading of a time in milliseconds must be time [ms]"
        )
        return
    found = found_scale(spectrum, scene)
    if found is not None:
        cause = (
            "are the speed (input_speed), the teeth and the unit of the time right?"
            if found.held is None
            else f"is gearset.held = {found.held}?"
        )
        yield (
            f"the strongest lines fit a mesh frequency {found.factor:.4g} times that of the scene: "
            f"{cause}"
        )


def found_scale(spectrum: MeshSpectrum, scene: Scene) -> Scale | None:
    """Factor on the mesh frequency of the scene with which the strongest lines are explained.

    Args:
        spectrum: of a measured vibration.
        scene: the gears.

    Returns:
        The factor nearest to 1; None if a line is at a mesh harmonic of the scene, or if no factor
        is certain.
    """
    lines = strongest_lines(spectrum.axis, spectrum.amplitude, LINES)  # also outside the band
    if spectrum.mesh is None or not lines or any(_at_harmonic(line, spectrum) for line in lines):
        return None
    held_factors, sidebands = _held_factors(scene), Sidebands.of(scene)
    found = []
    for harmonic in range(1, HARMONICS + 1):
        mesh = lines[0].place / harmonic
        factor, near = mesh / spectrum.mesh, float(spectrum.axis[1]) / mesh
        held = next((m for m, f in held_factors.items() if abs(f / factor - 1.0) <= near), None)
        known = held is not None or abs(factor - 1.0) <= CLOSE
        if _explains(lines, mesh, near, sidebands, known):
            found.append(Scale(factor, held))
    return min(found, key=lambda scale: max(scale.factor, 1.0 / scale.factor), default=None)


def _at_harmonic(line: Line, spectrum: MeshSpectrum) -> bool:
    """Whether a line is at a mesh harmonic of the scene."""
    harmonic = spectrum.harmonic(line.place)
    if harmonic is None or spectrum.mesh is None:
        return False
    return abs(line.place - harmonic * spectrum.mesh) <= EXACT * float(spectrum.axis[1])


def _explains(
    lines: list[Line], mesh: float, near: float, sidebands: Sidebands, known: bool
) -> bool:
    """Whether most of the vibration is at harmonics of a mesh frequency and their sidebands.

    Unless the cause of the factor is `known`, a pair of sidebands is needed.
    """
    orders = {line: line.place / mesh for line in lines}
    at_harmonic = {
        line
        for line, order in orders.items()
        if 1 <= round(order) <= HARMONICS and abs(order - round(order)) <= near
    }
    beside = {line: sidebands.at(order, near) for line, order in orders.items()}
    every = {sideband for found in beside.values() for sideband in found}
    pair = any(sideband._replace(number=-sideband.number) in every for sideband in every)
    explained = at_harmonic | {line for line, found in beside.items() if found}
    energy = sum(line.amplitude**2 for line in explained)
    most = energy > MOST_OF * sum(line.amplitude**2 for line in lines)
    return most and len(explained) >= FEWEST and (known or pair)


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
