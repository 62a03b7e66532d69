"""Warnings about the results of a run."""

from __future__ import annotations

from collections.abc import Iterator

from ..checks.accuracy import accuracy_warnings
from ..checks.ledger import balance_of_run, ledger_warning
from ..run.result import Result
from ..scene import Scene
from ..studies.doubts import clipping_of_run
from ..studies.measures import clipped_friction
from .backlash import backlash_of_scene
from .damage import damage_remarks
from .deflection import deflection_warning
from .pressure import pressure_warning
from .turning import turning_warnings


def remarks(scene: Scene, run: Result, tolerance: float) -> Iterator[str]:
    """Warnings that apply to the results of a run, a line each."""
    if line := ledger_warning(balance_of_run(run.energy), tolerance):
        yield line
    if line := backlash_of_scene(scene):
        yield line
    yield from accuracy_warnings(scene, run)
    yield from turning_warnings(scene, run)
    if scene.lubrication.friction and scene.lubrication.friction_torque == "printed":
        yield (
            "lubrication.friction_torque = printed: (17) to (20) of Salagianni et al. have the "
            "wrong sign, and count the loss twice: friction drives the gears, and power loss and "
            "efficiency are those of no gearbox"
        )
    for look in (deflection_warning, pressure_warning):
        if line := look(scene, run):
            yield line
    yield from damage_remarks(scene, run.damage)
    if line := clipping_of_run(clipped_friction(scene, run)):
        yield line
