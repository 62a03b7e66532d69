"""Functions shared by the commands that run studies: output as table or picture, progress."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..terminal.console import progress
from ..terminal.messages import need, remark, warn
from ..terminal.output_files import PICTURES
from ..terminal.settings import say_units

if TYPE_CHECKING:
    import pyarrow as pa

    from ..scene import Scene
    from ..studies.axes import Axis, Normal, Span
    from ..studies.plan import Study
    from ..studies.work import Executor, Failure, Report

PICTURE_DPI = 150  # dots per inch


def need_packages(out: Path) -> None:
    """End the command if packages are missing that tables of studies, or the file `out`, need."""
    need("studies", "pyarrow")
    if out.suffix in PICTURES:
        need("plots", "matplotlib")


def axis(scene: Scene, field: str, text: str) -> Axis | Span | Normal:
    """Parse the values of a field, and print in which unit numbers without unit were read.

    Args:
        scene: has the field.
        field: dotted name.
        text: values or a range, see `read_axis`.

    Returns:
        The values, or the range.

    Raises:
        ValueError: see `read_axis`.
    """
    from ..studies.axes import read_axis
    from ..units.conversion import is_number

    found = read_axis(scene, field, text)
    if is_number(text.removeprefix("normal(").replace(":", ",").split(",")[0]):
        for value in dict.fromkeys(found.ends):
            say_units(scene.replace(**{field: value}), {field: value})
    return found


@contextmanager
def computed(study: Study, out: Path, scheduler: str | None = None) -> Iterator[pa.Table]:
    """Compute a study, with a progress bar.

    Args:
        study: points to compute.
        out: file that the results are for. Completed points are kept in a journal beside it, until
            the block ends without an error.
        scheduler: address of a Dask scheduler, or number of threads; None is a thread per core.

    Yields:
        The results, a row per point.

    Raises:
        ValueError: `scheduler` is not a positive number, or the journal is of another study.
        OSError: the journal cannot be written, or the scheduler cannot be reached.
    """
    from ..studies.sweep import sweep

    journal = out.with_name(f"{out.name}.journal")
    with (
        executor_of(scheduler) as executor,
        reported("points", len(study.points)) as report,
        kept(journal, len(study.points)),
    ):
        table = sweep(study, executor, journal, report)
    yield table
    journal.unlink()


@contextmanager
def kept(journal: Path, points: int, what: str = "points") -> Iterator[None]:
    """Say what is kept if the study is interrupted.

    Args:
        journal: file with a line for each completed point.
        points: number of points of the study.
        what: they are.
    """
    try:
        yield
    except KeyboardInterrupt:
        done = len(journal.read_text().splitlines()) if journal.exists() else 0
        remark(
            f"interrupted: {done} of {points} {what} are kept in {journal}; repeat the command to "
            "continue, or delete this file to start again"
        )
        raise


@contextmanager
def executor_of(scheduler: str | None, threads: int | None = None) -> Iterator[Executor]:
    """What runs many tasks.

    Args:
        scheduler: address of a Dask scheduler, or number of threads; None takes `threads`.
        threads: None is a thread per core.

    Yields:
        Threads of this process, or the workers of the scheduler.

    Raises:
        ValueError: the number of threads is not positive, or the scheduler cannot be reached.
    """
    if scheduler is None or scheduler.isdecimal():
        if scheduler is not None and int(scheduler) < 1:
            raise ValueError(f"--scheduler = {scheduler!r}: must be at least 1 thread")
        from ..simulation.threads import Threads

        yield Threads(threads if scheduler is None else int(scheduler))
        return
    need("studies", "distributed")
    from ..studies.cluster import Cluster

    cluster = Cluster(scheduler)
    try:
        yield cluster
    finally:
        cluster.close()


@contextmanager
def reported(what: str, total: int) -> Iterator[Report]:
    """A progress bar of the points of a study, above which failures are printed.

    Args:
        what: label of the bar.
        total: number of points.
    """
    with progress(what, total) as advance:

        def report(done: int, failure: Failure | None) -> None:
            advance(done)
            if failure is not None:
                remark(failure.reason)

        yield report


def write_results(
    table: pa.Table,
    out: Path,
    x: str | None = None,
    measures: Sequence[str] = (),
    by: str | None = None,
    kind: str | None = None,
) -> None:
    """Write `table` as a table or as a picture, according to the suffix of `out`.

    Args:
        table: of a study, a row per point.
        out: file to write.
        x: field of the horizontal axis, see `plot_study` for this and the following.
        measures: columns to draw, a panel each.
        by: field that distinguishes the curves.
        kind: see `plot_study`; None chooses by the fields.

    Raises:
        OSError: `out` cannot be written.
        ValueError: the table cannot be drawn.
    """
    if out.suffix in PICTURES:
        from ..plots.study import plot_study
        from ..plots.style import save

        save(plot_study(table, x, measures, by, kind), str(out), PICTURE_DPI)
    else:
        from ..studies.table import write

        write(table, out)


def warn_of(table: pa.Table, scenes: Sequence[Scene]) -> None:
    """Print the warnings that apply to the results of a study, a line each.

    Args:
        table: results.
        scenes: scenes that were computed, such as those of `Study.extremes`.
    """
    from ..checks.fixed_axes import held_axes_warning
    from ..explanation.backlash import backlash_of_scene
    from ..explanation.deflection import deflection_warning
    from ..explanation.oil import oil_of_scenes
    from ..explanation.pressure import pressure_warning
    from ..studies.doubts import clipping_of_study, inaccuracies, unbalanced_runs
    from ..studies.turning import turning_of_study

    for judge in (held_axes_warning, backlash_of_scene, deflection_warning, pressure_warning):
        warn([next(filter(None, map(judge, scenes)), None)])
    warn((oil_of_scenes(scenes), clipping_of_study(table), unbalanced_runs(table)))
    warn((*inaccuracies(table), *turning_of_study(table)))
