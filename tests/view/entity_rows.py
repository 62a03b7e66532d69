"""Rows of an entity in a file of the viewer, and what its own program says of the file."""

import subprocess
from pathlib import Path

import numpy as np
import rerun_cli
from rerun.chunk import RrdReader


def rerun(*arguments):
    """Text of `rerun rrd`."""
    program = Path(rerun_cli.__file__).parent / "rerun"
    done = subprocess.run([program, "rrd", *arguments], capture_output=True, text=True, check=True)
    return done.stdout + done.stderr


def rows(rrd, path, component="Scalars:scalars"):
    """Simulated times [s] and rows of an entity."""
    found = []
    for chunk in RrdReader(rrd).stream():
        batch = chunk.to_record_batch()
        if chunk.entity_path == path and component in batch.schema.names and not chunk.is_static:
            times = np.array(batch.column("simulated_time").cast("int64").to_pylist()) * 1e-9
            found += zip(times, batch.column(component).to_pylist(), strict=True)
    return found
