"""What whoever reads the figures of a run must know of it, in lines."""

from __future__ import annotations

from collections.abc import Iterator

from ..accuracy import accuracy_warnings
from ..ledger_check import balance_of_run, ledger_warning
from ..result import Result
from ..scene import Scene
from ..studies.clipping import clipping_of_run
from ..studies.measures import clipped_friction


def remarks(scene: Scene, run: Result, tolerance: float) -> Iterator[str]:
    """What limits the figures of a `run` of `scene` at a `tolerance`."""
    if line := ledger_warning(balance_of_run(run.energy), tolerance):
        yield line
    yield from accuracy_warnings(scene, run)
    if told := clipping_of_run(clipped_friction(scene, run)):
        yield told
