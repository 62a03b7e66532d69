"""`planetary-twin import`: what a rig has measured, as a recording."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ._arguments import SetOption, complete_scene
from ._console import make_console
from ._fail import fail, need
from ._output import check_recording
from ._settings import changed_scene, settings

if TYPE_CHECKING:
    from ..recording.tables.rig_recording import Imported


def import_(
    table: Annotated[
        Path,
        typer.Argument(
            metavar="TABLE", help="CSV or Parquet; headings name fields: time, power_loss [kW]."
        ),
    ],
    out: Annotated[Path, typer.Option(help="Folder of the recording, or one file NAME.mcap.")],
    scene: Annotated[
        str,
        typer.Option(
            help="The gearbox: packaged scene, or path of a YAML file.",
            autocompletion=complete_scene,
        ),
    ] = "paper",
    set_: SetOption = None,
) -> None:
    """Write TABLE, which a rig has measured, as a recording that `fit` and `view` take.

    A row tells of the interval that ends at its time stamp. Columns are named as `export` names
    those of gearbox_state and operating_point.

    Example: planetary-twin import rig.csv --scene paper --out recordings/rig
    """
    check_recording("--out", out)
    need("analysis", "mcap", "rosbags", "pyarrow")
    from ..recording.tables.rig_recording import write_measured

    try:
        done = write_measured(table, changed_scene(scene, settings(set_ or [])), out)
    except ValueError as error:
        fail(error)
    except OSError as error:
        fail(error if error.filename is None else f"{error.filename}: {error.strerror}")
    for line in _told(out, done):
        make_console().print(line, highlight=False, soft_wrap=True)


def _told(out: Path, done: Imported) -> Iterator[str]:
    """How much was written, and where operating points begin."""
    from ..scene import TUNABLES

    step = done.measured.step
    yield f"{out}: {done.measured.rows} rows, one every {step:g} s"
    for part in done.held:
        means = (f"{name} = {v:.6g} {TUNABLES[name].unit}" for name, v in part.means.items())
        yield f"from {part.first * step:g} s on: {', '.join(means) or 'as in the scene'}"
