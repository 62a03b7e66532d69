"""What the commands that run studies share: a table or its picture as the outcome, and a bar."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ._fail import fail, need, remark
from ._output import check_file
from ._settings import say_units

if TYPE_CHECKING:
    import pyarrow as pa

    from ..scene import Scene
    from ..studies.axes import Axis, Span

TABLES = (".parquet", ".csv")
PICTURES = (".png", ".svg", ".pdf")
PRINTED = 150  # dots per inch


def check_suffix(out: Path, admitted: Sequence[str]) -> None:
    """End the command where `out` is none of these, cannot be written, or lacks what writes it."""
    if out.suffix not in admitted:
        fail(f"--out = {str(out)!r}: must end in {', '.join(admitted)}")
    check_file("--out", out)
    need("studies", "pyarrow")
    if out.suffix in PICTURES:
        need("plots", "matplotlib")


def axis(scene: Scene, field: str, text: str) -> Axis | Span:
    """Read the values of a field, and say in which unit bare numbers were taken.

    Args:
        scene: that has the field.
        field: dotted name.
        text: values or a range, see `read_axis`.

    Returns:
        The values, or the range.

    Raises:
        ValueError: see `read_axis`.
    """
    from ..studies.axes import Axis, read_axis
    from ..units import is_number

    found = read_axis(scene, field, text)
    ends = (
        (found.values[0], found.values[-1]) if isinstance(found, Axis) else (found.low, found.high)
    )
    if is_number(text.replace(":", ",").split(",")[0]):
        for value in dict.fromkeys(ends):
            say_units(scene.replace(**{field: value}), {field: value})
    return found


def put(
    table: pa.Table,
    out: Path,
    x: str | None = None,
    measures: Sequence[str] = (),
    by: str | None = None,
    kind: str | None = None,
) -> None:
    """Write `table`, or draw it (see `plot_study`), by the suffix of `out`.

    Raises:
        OSError: it cannot be written.
        ValueError: it cannot be drawn.
    """
    if out.suffix in PICTURES:
        from ..plots.study import plot_study
        from ..plots.style import save

        save(plot_study(table, x, measures, by, kind), str(out), PRINTED)
    else:
        from ..studies.table import write

        write(table, out)


def warn(table: pa.Table) -> None:
    """Print what limits the figures of a study, a line each."""
    from ..studies.clipping import clipping_of_study
    from ..studies.inaccurate import inaccuracies
    from ..studies.unclosed import unclosed_ledgers

    lines = (clipping_of_study(table), unclosed_ledgers(table), *inaccuracies(table))
    for line in filter(None, lines):
        remark(f"warning: {line}")


@contextmanager
def progress(what: str, total: int) -> Iterator[Callable[[int], None]]:
    """A bar with the time that is left, on stderr; call it with how many more are done."""
    from rich.console import Console
    from rich.progress import MofNCompleteColumn, Progress, TimeRemainingColumn

    columns = (*Progress.get_default_columns()[:2], MofNCompleteColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True)) as bar:
        task = bar.add_task(what, total=total)
        yield lambda done: bar.advance(task, done)
