"""What whoever reads the figures of a run must know of it, in lines."""

from __future__ import annotations

from collections.abc import Iterator

from ..result import Result
from ..scene import Scene
from ..studies.clipping import clipping_of_run
from ..studies.measures import clipped_friction


def remarks(scene: Scene, run: Result) -> Iterator[str]:
    """What limits the figures of a `run` of `scene`."""
    if told := clipping_of_run(clipped_friction(scene, run)):
        yield told
