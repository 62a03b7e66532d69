"""The resonant speeds of a scene in words."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..scene import Scene
from ..units.conversion import rpm
from ..units.engineering import figure
from .campbell import HARMONICS, LEAST_SHARE, Resonance
from .excitation import EXCITED

_NOT_EXCITED = (
    "Frequencies that meet without resonance, if the planets are equal; errors of position, form "
    "or stiffness, and faults, excite what phasing suppresses:"
)


def resonance_lines(scene: Scene, found: Sequence[Resonance]) -> Iterator[str]:
    """Resonant speeds under a heading, first those that the meshing excites.

    Args:
        scene: the scene.
        found: its resonances at the mean mesh stiffness.
    """
    excited = [resonance for resonance in found if resonance.excitation == EXCITED]
    strongest = max((resonance.weight for resonance in excited), default=0.0)
    yield _heading(scene, strongest > 0.0)
    for resonance in excited:
        share = f", {resonance.weight / strongest:.0%} of the strongest" if strongest else ""
        yield _line(resonance) + share
    if not excited:
        yield "none"
    others = [resonance for resonance in found if resonance.excitation != EXCITED]
    if others:
        yield _NOT_EXCITED
    for resonance in others:
        yield f"{_line(resonance)}, {resonance.excitation}"


def in_rpm(speed: float, digits: str = "g") -> str:
    """A speed with its customary unit.

    Args:
        speed: [rad/s].
        digits: format of the number.
    """
    return f"{speed / rpm(1.0):{digits}} rpm"


def _heading(scene: Scene, weighted: bool) -> str:
    which = f"harmonics 1 to {HARMONICS} of the mesh frequency"
    if weighted:
        torque = figure(scene.operating_point.input_torque, "N m")
        which += (
            f" and higher ones with {LEAST_SHARE:.0%} of the strongest (by the force of mesh "
            f"stiffness and errors of form on the mode at input_torque = {torque}, undamped)"
        )
    second = scene.operating_point.second_input_speed
    limit = f"up to {in_rpm(scene.drive.speed_limit, '.0f')} (drive.speed_limit)"
    speeds = f"speeds {limit}"
    if second:
        speeds = (
            f"speeds of the first motor {limit} in both senses, the second one at "
            f"{in_rpm(second)} (second_input_speed)"
        )
    return f"Resonances at mean mesh stiffness, {which}, {speeds}:"


def _line(resonance: Resonance) -> str:
    numbers = range(resonance.mode + 1, resonance.mode + 1 + resonance.multiplicity)
    modes = f"mode{'s' * (len(numbers) > 1)} {', '.join(map(str, numbers))}"
    return (
        f"{in_rpm(resonance.speed, '10.1f')}: harmonic {resonance.harmonic} "
        f"of the mesh frequency meets {modes} at {resonance.frequency:.1f} Hz"
    )
