"""`planetary-twin dataset`: labelled vibration of many gearboxes, with and without faults."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from ..terminal.arguments import JsonOption
from ..terminal.json_output import console_beside, write_json
from ..terminal.messages import ignore_remarks, need, one_line_errors, warn
from ._study import executor_of, kept, reported

if TYPE_CHECKING:
    from ..datasets.folder import Written


def dataset(
    spec: Annotated[
        Path, typer.Argument(metavar="SPEC", help="YAML file: what the data set consists of.")
    ],
    out: Annotated[
        Path,
        typer.Option(metavar="FOLDER", help="Folder to create, or to continue if interrupted."),
    ],
    workers: Annotated[
        int | None, typer.Option(help="Number of threads.", show_default="a thread per core")
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="Address of a Dask scheduler, e.g. tcp://10.0.0.1:8786."
        ),
    ] = None,
    json_: JsonOption = None,
) -> None:
    """Simulate a labelled data set: specimens with errors of their own, healthy and faulty.

    SPEC names a scene with sensors, the fields that are drawn for each specimen, faults with
    distributions of their severities, operating points and the number of repetitions. FOLDER gets
    Parquet tables split by specimen, a card for Hugging Face, a datasheet, Croissant metadata and
    checksums. The data are the same with any number of workers. To resume an interrupted data set,
    repeat the command.

    Example: planetary-twin dataset docs/examples/dataset.yaml --out cracks --workers 2
    """
    need("studies", "pyarrow", "mcap", "rosbags")
    from ..datasets.folder import check_folder, write_dataset
    from ..datasets.plan import DatasetPlan
    from ..datasets.produce import journal_in
    from ..datasets.spec import read_spec

    ignore_remarks()
    with one_line_errors():
        given, scene = read_spec(spec)
        try:
            plan = DatasetPlan(given, scene)
            check_folder(plan, out)
            records = list(plan.records())
        except ValueError as error:
            raise ValueError(f"{spec}: {error}") from None
        with (
            executor_of(scheduler, workers) as executor,
            reported("records", given.records) as report,
            kept(journal_in(out), given.records, "records"),
        ):
            written = write_dataset(plan, records, out, executor, report)
    console = console_beside(json_)
    for line in _lines(written, out):
        console.print(line, markup=False)
    warn(_warnings(written))
    write_json(written._asdict() | {"folder": str(out)}, json_)


def _lines(written: Written, out: Path) -> list[str]:
    """The data set in words."""
    states = ", ".join(f"{count} {label}" for label, count in written.labels.items())
    parts = ", ".join(f"{count} {part}" for part, count in written.specimens.items())
    return [f"{out}: {written.records} records: {states}", f"specimens: {parts}"]


def _warnings(written: Written) -> list[str]:
    found = []
    if written.remarked:
        found.append(
            f"{written.remarked} of {written.records} runs have a remark, the first: "
            f"{written.remark}"
        )
    if written.clipped:
        found.append(f"{written.clipped} of {written.signals} signals have clipped samples")
    return found
