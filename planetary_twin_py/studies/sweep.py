"""Executes a study and returns its table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from ..units.catalogue import AXES_RESULTS, STUDY_RESULTS
from .journal import Journal
from .plan import Study
from .work import Evaluation, Executor, Failure, Found

if TYPE_CHECKING:
    import pyarrow as pa

Report = Callable[[int, Failure | None], None]


def sweep(
    study: Study,
    executor: Executor,
    journal: Path | None = None,
    report: Report = lambda done, failure: None,
) -> pa.Table:
    """Run the points of `study` that are not yet in `journal`, and tabulate all points.

    Args:
        study: study from `grid` or `latin_hypercube`.
        executor: runs the points.
        journal: file of completed points, from which an interrupted study resumes; the caller
            deletes it. None stores nothing.
        report: called with the number of points completed since the last call, and the failure.

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
    results_file = Journal(journal) if journal else None
    known = results_file.done if results_file else {}
    results: dict[int, Found] = {place: known[key] for place, key in keys.items() if key in known}
    report(len(results), None)
    remaining = (point for point in study.points if point.place not in results)
    try:
        for point, result in executor.run(Evaluation(study.scene, study.settings), remaining):
            results[point.place] = result
            if results_file:
                results_file.add(keys[point.place], result)
            report(1, result if isinstance(result, Failure) else None)
    finally:
        if results_file:
            results_file.close()
    return tabulate(study, results)
