"""Data of all entries: the two scenes and their studies."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

from planetary_twin_py.scene import Scene, load_scene

from .study import Grid, Study, run_studies

DEFAULT, PRINTED = "paper", "paper_printed"


class Evidence(NamedTuple):
    """Both scenes with their studies."""

    scene: Scene
    printed: Scene
    study: Study
    printed_study: Study


def gather(
    grid: Grid,
    jobs: int,
    progress: Callable[[Iterable[Any], int], Iterable[Any]] = lambda runs, _: runs,
) -> Evidence:
    """Run both studies.

    Args:
        grid: values of the study.
        jobs: number of processes.
        progress: see `run_studies`.

    Returns:
        Scenes and studies.
    """
    studies = run_studies((DEFAULT, PRINTED), grid, jobs, progress)
    return Evidence(load_scene(DEFAULT), load_scene(PRINTED), studies[DEFAULT], studies[PRINTED])
