"""Executes a study and returns its table."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import nullcontext
from pathlib import Path
from typing import TYPE_CHECKING

from ..units.catalogue import AXES_RESULTS, STUDY_RESULTS
from .journal import Journal
from .plan import Point, Study
from .work import Evaluation, Executor, Failure, Found, Report

if TYPE_CHECKING:
    import pyarrow as pa


def sweep(
    study: Study,
    executor: Executor,
    journal: Path | None = None,
    report: Report = lambda done, failure: None,
    evaluate: Callable[[Point], Found] | None = None,
) -> pa.Table:
    """Run the points of `study` that are not yet in `journal`, and tabulate all points.

    Args:
        study: study from `grid` or `latin_hypercube`.
        executor: runs the points.
        journal: file of completed points, from which an interrupted study resumes; the caller
            deletes it. None stores nothing.
        report: called with the number of points completed since the last call, and the failure.
        evaluate: gives the results of a point, or its failure; it is pickled for other processes.
            None runs the scene with the settings of the study.

    Returns:
        A row per point.

    Raises:
        OSError: the journal cannot be written.
    """
    from .._core import SOURCES
    from .table import tabulate

    # A journal of another core, or with other measures, is not resumed.
    versions = "/".join((SOURCES, *STUDY_RESULTS, *AXES_RESULTS))
    keys = {point.place: study.key(point, versions) for point in study.points}
    with Journal(journal) if journal else nullcontext() as kept:
        known = kept.done if kept else {}
        results = {place: known[key] for place, key in keys.items() if key in known}
        report(len(results), None)
        remaining = [point for point in study.points if point.place not in results]
        evaluate = evaluate or Evaluation(study.scene, study.settings)
        for point, result in executor.run(evaluate, remaining):
            results[point.place] = result
            if kept:
                kept.add(keys[point.place], result)
            report(1, result if isinstance(result, Failure) else None)
    return tabulate(study, results)
