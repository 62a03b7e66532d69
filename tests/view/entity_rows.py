"""Rows of an entity in a file of the viewer."""

import numpy as np
from rerun.chunk import RrdReader


def rows(rrd, path, component="Scalars:scalars"):
    """Simulated times [s] and rows of an entity."""
    found = []
    for chunk in RrdReader(rrd).stream():
        batch = chunk.to_record_batch()
        if chunk.entity_path == path and component in batch.schema.names and not chunk.is_static:
            times = np.array(batch.column("simulated_time").cast("int64").to_pylist()) * 1e-9
            found += zip(times, batch.column(component).to_pylist(), strict=True)
    return found
