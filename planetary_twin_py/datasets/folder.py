"""A data set as a folder."""

from __future__ import annotations

import hashlib
import json
import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import yaml

from ..scene.quantity import Section
from ..studies.work import Executor, Report
from .card import card
from .columns import PULSES, SAMPLES, SERIES, Column, rows_of, table_columns
from .croissant import SPLITS, croissant
from .datasheet import datasheet
from .plan import DatasetPlan, Record
from .produce import WORK, Store, produce
from .tables import write_samples, write_signals

CHECKSUMS = "checksums.txt"
RUNS = "runs.parquet"
SCENE = "scene.yaml"
ROOM = 2.5  # times the samples: while they are written as tables they are there twice


class Written(NamedTuple):
    """What a finished data set has."""

    records: int
    signals: int
    specimens: dict[str, int]
    """By part."""
    labels: dict[str, int]
    """Records by label."""
    clipped: int
    """Signals with clipped samples."""
    remarked: int
    """Runs whose accuracy is limited."""
    remark: str
    """Of the first of them."""


def check_folder(plan: DatasetPlan, out: Path) -> None:
    """Check that a data set can be written, before anything is simulated.

    Args:
        plan: of the data set.
        out: its folder.

    Raises:
        ValueError: the folder has other files, or the disk has not enough room.
    """
    if out.exists() and not out.is_dir():
        raise ValueError(f"--out = {str(out)!r}: is a file; name a folder")
    if out.exists() and any(out.iterdir()) and not (out / WORK).is_dir():
        raise ValueError(f"--out = {str(out)!r}: already exists; choose another name")
    above = out
    while not above.exists():
        above = above.parent
    spec = plan.spec
    needed, free = (
        ROOM * 4.0 * sum(plan.counts.values()) * spec.records,
        shutil.disk_usage(above).free,
    )
    if needed > free:
        raise ValueError(
            f"--out = {str(out)!r}: {spec.records} records need {needed / 1e9:.3g} GB, and "
            f"{free / 1e9:.3g} GB are free"
        )


def write_dataset(
    plan: DatasetPlan, records: Sequence[Record], out: Path, executor: Executor, report: Report
) -> Written:
    """Simulate a data set and write its folder; an interrupted one is continued.

    Args:
        plan: of the data set.
        records: all of its records.
        out: its folder.
        executor: runs the records.
        report: called with the number of records completed since the last call.

    Returns:
        What it has.

    Raises:
        ValueError: a record cannot be simulated.
        OSError: the folder cannot be written.
    """
    store = Store(plan, out)
    found = produce(plan, records, store, executor, report)
    columns = table_columns(plan)
    rows = [row for record in records for row in rows_of(plan, record, found[store.key(record)])]
    shutil.rmtree(out / "data", ignore_errors=True)  # of a run that was ended while writing
    (out / "data").mkdir()
    files = [RUNS, *_data(plan, out, columns, records, store, found)]
    write_signals(columns, rows, out / RUNS)
    digests = {name: _sha256(out / name) for name in files}
    texts = {
        "README.md": card(plan, columns, records),
        "datasheet.md": datasheet(plan, records),
        "croissant.json": json.dumps(croissant(plan, columns, digests), indent=2) + "\n",
        "spec.yaml": _yaml(plan.spec.model_copy(update={"scene": SCENE, "set": {}}), True),
        SCENE: _yaml(plan.base),
    }
    for name, text in texts.items():
        (out / name).write_text(text, "utf-8")
        digests[name] = _sha256(out / name)
    if plan.spec.mcap:
        names = (f"mcap/{record.name}.mcap" for record in records)
        digests |= {name: _sha256(out / name) for name in names}
    lines = (f"{digest}  {name}\n" for name, digest in sorted(digests.items()))
    (out / CHECKSUMS).write_text("".join(lines), "utf-8")
    shutil.rmtree(store.folder)
    return _written(plan, records, rows)


def _data(
    plan: DatasetPlan,
    out: Path,
    columns: Sequence[Column],
    records: Sequence[Record],
    store: Store,
    found: Mapping[str, Any],
) -> Iterator[str]:
    """Write the tables with samples; yields their names."""
    longest = max(plan.counts.values())
    for split in SPLITS:
        own = [record for record in records if record.split == split]
        if not own:
            continue
        name = f"data/{split}-00000-of-00001.parquet"
        rows = _rows_with_samples(plan, own, store, found)
        write_samples((*columns, *SERIES), rows, longest, out / name)
        yield name


def _rows_with_samples(
    plan: DatasetPlan, records: Sequence[Record], store: Store, found: Mapping[str, Any]
) -> Iterator[dict[str, Any]]:
    for record in records:
        key = store.key(record)
        signals, pulses = store.get(key)
        for row, samples in zip(rows_of(plan, record, found[key]), signals, strict=True):
            yield row | {SAMPLES.name: samples, PULSES.name: pulses}


def _yaml(section: Section, brief: bool = False) -> str:
    """A section as YAML; if brief, without what has its default."""
    fields = section.model_dump(mode="json", exclude_defaults=brief)
    return yaml.safe_dump(fields, sort_keys=False)


def _sha256(path: Path) -> str:
    with path.open("rb") as stream:
        return hashlib.file_digest(stream, "sha256").hexdigest()


def _written(
    plan: DatasetPlan, records: Sequence[Record], rows: Sequence[dict[str, Any]]
) -> Written:
    labels = dict.fromkeys(plan.labels, 0)
    for record in records:
        labels[plan.states[record.state].label] += 1
    remarks = {row["recording_id"]: row["remarks"] for row in rows}
    remarked = [text for text in remarks.values() if text]
    specimens = {name: plan.splits.count(name) for name in SPLITS if name in plan.splits}
    clipped = sum(row["n_clipped"] > 0 for row in rows)
    first = next(iter(remarked), "")
    return Written(len(records), len(rows), specimens, labels, clipped, len(remarked), first)
