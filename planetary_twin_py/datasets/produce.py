"""Simulates the records of a data set that are not yet there, in any order, on any workers."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from ..recording.runs.origin import makers_here
from ..studies.journal import Journal
from ..studies.work import Executor, Failure, Report
from .plan import DatasetPlan, Record
from .record import Recorder, Taken

WORK = ".unfinished"
"""Folder of what is done, in that of a data set that is not finished."""
JOURNAL = "journal"


class Store:
    """Finished records in the folder of an unfinished data set.

    Args:
        plan: of the data set.
        folder: of the data set.

    Raises:
        OSError: the folder cannot be written.
    """

    def __init__(self, plan: DatasetPlan, folder: Path) -> None:
        self.folder, self.journal = folder / WORK, journal_in(folder)
        self.recordings = folder / "mcap"
        for each in (self.folder, *([self.recordings] if plan.spec.mcap else [])):
            each.mkdir(parents=True, exist_ok=True)
        spec = plan.spec
        content = {
            "scene": plan.scene.model_dump(mode="json", exclude={"name", "description"}),
            "settings": [spec.duration, spec.settling, spec.tolerance, spec.seed, spec.mcap],
            "makers": asdict(makers_here()),
        }
        self._common = json.dumps(content, sort_keys=True)

    def key(self, record: Record) -> str:
        """Digest of everything that determines a record, 32 hexadecimal digits.

        Args:
            record: of the plan.
        """
        place = record.specimen, record.point, record.repetition, record.run
        content = [self._common, place, record.changes, record.course.model_dump()]
        return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:32]

    def put(self, key: str, taken: Taken) -> None:
        """Store the samples of a record.

        Args:
            key: of the record.
            taken: what has been recorded.
        """
        part = self.folder / f".{key}.part"
        with part.open("wb") as stream:
            np.savez(stream, *(signal.samples for signal in taken.signals), taken.pulses)
        os.replace(part, self._file(key))

    def put_recording(self, name: str, data: bytes) -> None:
        """Store the recording of a run, where the finished data set has it.

        Args:
            name: of the run.
            data: content of the file.
        """
        part = self.folder / f".{name}.part"
        part.write_bytes(data)
        os.replace(part, self.recordings / f"{name}.mcap")

    def get(self, key: str) -> tuple[list[np.ndarray], np.ndarray]:
        """Samples of the sensors of a record, (n,) each, and times of pulses [s], (pulses,).

        Args:
            key: of the record.
        """
        with np.load(self._file(key)) as arrays:
            *samples, pulses = (arrays[name] for name in arrays.files)
        return samples, pulses

    def _file(self, key: str) -> Path:
        return self.folder / f"{key}.npz"


def journal_in(folder: Path) -> Path:
    """Journal of an unfinished data set."""
    return folder / WORK / JOURNAL


def kept_of(taken: Taken) -> dict[str, Any]:
    """What the journal has of a record: figures of the run, and columns of each signal."""
    signals = [
        {
            "channel": signal.sensor,
            "sensor_kind": signal.kind,
            "unit": signal.unit,
            "fs": signal.rate,
            "n_samples": len(signal.samples),
            "n_clipped": signal.clipped,
        }
        for signal in taken.signals
    ]
    return {**taken.figures, "signals": signals}


def produce(
    plan: DatasetPlan, records: Sequence[Record], store: Store, executor: Executor, report: Report
) -> Mapping[str, Any]:
    """Simulate the records that are not in the store.

    Args:
        plan: of the data set.
        records: all of its records.
        store: of finished records, from which an interrupted data set resumes.
        executor: runs the records.
        report: called with the number of records completed since the last call.

    Returns:
        What the journal has of each record, by key.

    Raises:
        ValueError: a record cannot be simulated; those that are finished stay in the store.
        OSError: the store cannot be written.
    """
    keys = {record.name: store.key(record) for record in records}
    with Journal(store.journal) as journal:
        remaining = [record for record in records if keys[record.name] not in journal.done]
        report(len(records) - len(remaining), None)
        for record, taken in executor.run(Recorder(plan.spec, plan.scene), remaining):
            if isinstance(taken, Failure):
                raise ValueError(taken.reason)
            store.put(keys[record.name], taken)
            if taken.recording is not None:
                store.put_recording(record.name, taken.recording)
            journal.add(keys[record.name], kept_of(taken))
            report(1, None)
        return {key: journal.done[key] for key in keys.values()}
