"""A study from its plan to its table."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from .._compile import cache_folder
from .journal import Journal
from .measures import MEASURES
from .plan import Study
from .work import Crew, Failure, Found, Work

if TYPE_CHECKING:
    import pyarrow as pa

Hearer = Callable[[int, Failure | None], None]


def sweep(
    study: Study,
    crew: Crew,
    journal: Path | None = None,
    hear: Hearer = lambda done, failure: None,
) -> pa.Table:
    """Run the points of `study` that are not yet in `journal` and tabulate all of them.

    Args:
        study: what to run, see `grid` and `latin_hypercube`.
        crew: who runs it.
        journal: file of what is done; removed by whoever has put the table away. None: a kill
            loses what was done.
        hear: is told how many more points are done, and of one that failed, why.

    Raises:
        OSError: the journal cannot be written.
    """
    from .table import tabulate

    makers = "/".join((cache_folder().name, *MEASURES))  # a journal of other figures is of no use
    keys = {point.place: study.key(point, makers) for point in study.points}
    book = Journal(journal) if journal else None
    known = book.done if book else {}
    found: dict[int, Found] = {place: known[key] for place, key in keys.items() if key in known}
    hear(len(found), None)
    left = (point for point in study.points if point.place not in found)
    try:
        for point, outcome in crew.do(Work(study.scene, study.settings), left):
            found[point.place] = outcome
            if book:
                book.add(keys[point.place], outcome)
            hear(1, outcome if isinstance(outcome, Failure) else None)
    finally:
        if book:
            book.close()
    return tabulate(study, found)
