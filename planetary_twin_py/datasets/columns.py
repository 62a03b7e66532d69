"""Columns of the tables: a row for each signal, one sensor in one record.

Names are those of the tables of bearing-datasets 0.3 where they fit, so that sets can be mixed.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import pyarrow as pa

from ..scene.faults import Fault
from ..scene.quantity import unit_of
from ..studies.axes import look_up
from ..units.conversion import rpm
from .plan import DatasetPlan, Record

NORMAL = "normal"  # type of fault of a healthy gearbox
NONE = "none"  # of what does not apply


class Column(NamedTuple):
    """A column of a table."""

    name: str
    kind: pa.DataType
    unit: str
    text: str


SAMPLES = Column(
    "samples", pa.list_(pa.float32()), "", "of the sensor, in `unit`; counts: since the first one"
)
PULSES = Column(
    "pulse_times",
    pa.list_(pa.float64()),
    "s",
    "of the tachometer since the first sample; empty without one",
)
SERIES = (SAMPLES, PULSES)
"""Columns of the tables with samples, in addition to the others."""

COLUMNS = (
    Column("dataset", pa.string(), "", "name of the data set"),
    Column("split", pa.string(), "", "part of the data set; a specimen is in one part only"),
    Column("signal_id", pa.string(), "", "unique name of the signal"),
    Column("recording_id", pa.string(), "", "name of the run, which its signals share"),
    Column("specimen_id", pa.string(), "", "gearbox with its own errors, path and sensors"),
    Column("pair_id", pa.string(), "", "runs that differ in their faults and noise alone"),
    Column("native_label", pa.string(), "", "state of health, as the specification names it"),
    Column("fault_type", pa.string(), "", "kinds of fault, joined by +; normal: none"),
    Column("fault_location", pa.string(), "", "gears with faults, joined by +; none"),
    Column("gear", pa.string(), "", "gear of the first fault"),
    Column("planet", pa.string(), "", "planet of the first fault, if it is one of a planet"),
    Column("tooth", pa.string(), "", "tooth of the first fault; 0 meets planet 1 first"),
    Column("flank", pa.string(), "", "flank of the first fault, if it is one of a flank"),
    Column("fault_origin", pa.string(), "", "simulated, or none"),
    Column("fault_size_mm", pa.float64(), "mm", "depth of the first fault; 0: none"),
    Column("fault_severity", pa.float64(), "", "value of fault_severity_field in SI; 0: none"),
    Column("fault_severity_field", pa.string(), "", "field of the scene that grades the fault"),
    Column("fault_severity_level", pa.int32(), "", "third of the drawn severities; 0: healthy"),
    Column("faults", pa.string(), "", "all fields of all faults in SI, as JSON"),
    Column("channel", pa.string(), "", "name of the sensor"),
    Column("sensor_kind", pa.string(), "", "kind of the sensor"),
    Column("unit", pa.string(), "", "unit of the samples"),
    Column("fs", pa.float64(), "Hz", "sample rate"),
    Column("n_samples", pa.int64(), "", "number of samples"),
    Column("n_clipped", pa.int64(), "", "samples of the run beyond the range of the sensor"),
    Column("start", pa.float64(), "s", "simulated time of the first sample"),
    Column("speed_rpm", pa.float64(), "rpm", "mean speed of the input shaft in the record"),
    Column("speed_profile", pa.string(), "", "constant, increasing, decreasing or varying"),
    Column("load", pa.float64(), "Nm", "nominal torque at the input"),
    Column("load_unit", pa.string(), "", "unit of load"),
    Column("mesh_frequency", pa.float64(), "Hz", "mean mesh frequency in the record"),
    Column("operating_condition", pa.int32(), "", "number of the operating point"),
    Column("repetition", pa.int32(), "", "number of the repetition"),
    Column("seed", pa.int64(), "", "seed of the noise of the sensor"),
    Column("remarks", pa.string(), "", "what limits the accuracy of the simulation; empty: none"),
)


def table_columns(plan: DatasetPlan) -> tuple[Column, ...]:
    """Columns of the tables of a data set: `COLUMNS`, and what is drawn for the specimens.

    Args:
        plan: of the data set.
    """
    return (*COLUMNS, *(_drawn_column(plan, draw.field) for draw in plan.drawn))


def _drawn_column(plan: DatasetPlan, name: str) -> Column:
    info, value = look_up(plan.scene, name)
    kinds = {bool: pa.bool_(), int: pa.int64(), float: pa.float64()}
    text = f"of the specimen: {info.description or name}"
    return Column(name, kinds.get(type(value), pa.string()), unit_of(info) or "", text)


def rows_of(plan: DatasetPlan, record: Record, found: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Rows of a record by name of the column, without the samples.

    Args:
        plan: of the data set.
        record: of the plan.
        found: of the journal, see `produce.kept_of`.
    """
    spec, state = plan.spec, plan.states[record.state]
    scene = plan.scene.replace(**record.changes)
    common = {
        "dataset": spec.name,
        "split": record.split,
        "recording_id": record.name,
        "specimen_id": record.specimen_name,
        "pair_id": record.pair,
        "native_label": state.label,
        **_fault(scene.faults),
        "fault_severity": record.severity,
        "fault_severity_field": state.severity or NONE,
        "fault_severity_level": record.level,
        "speed_rpm": found["speed"] / rpm(1.0),
        "speed_profile": _profile(record),
        "load": scene.operating_point.input_torque,
        "load_unit": "Nm",
        "start": found["start"],
        "mesh_frequency": found["mesh_frequency"],
        "operating_condition": record.point,
        "repetition": record.repetition,
        "remarks": found["remarks"],
        **record.drawn,
    }
    seeds = {sensor.name: sensor.seed for sensor in scene.sensors}
    return [
        common
        | signal
        | {"signal_id": f"{record.name}/{signal['channel']}", "seed": seeds[signal["channel"]]}
        for signal in found["signals"]
    ]


def _fault(faults: tuple[Fault, ...]) -> dict[str, Any]:
    """Columns of the faults of a record."""
    given = [fault.model_dump(mode="json") for fault in faults]
    first = given[0] if given else {}
    depth = first.get("depth")
    return {
        "fault_type": "+".join(fault["kind"] for fault in given) or NORMAL,
        "fault_location": "+".join(map(_location, given)) or NONE,
        "gear": first.get("gear", NONE),
        "planet": str(first["planet"]) if _location(first) == "planet" else NONE,
        "tooth": str(first.get("tooth", NONE)),
        "flank": first.get("flank", NONE),
        "fault_origin": "simulated" if faults else NONE,
        "fault_size_mm": 0.0 if not faults else math.nan if depth is None else 1e3 * depth,
        "faults": json.dumps(given, sort_keys=True),
    }


def _location(fault: Mapping[str, Any]) -> str:
    """Gear or bearing of a fault; of one without, such as that of a pin, the planet if any."""
    return str(fault.get("gear", fault.get("bearing", "planet" if "planet" in fault else NONE)))


def _profile(record: Record) -> str:
    """How the speed changes, in the words of bearing-datasets."""
    course = record.course
    if course.speed_wander:
        return "varying"
    if not course.speed_ramp:
        return "constant"
    return "increasing" if course.speed_ramp > 0.0 else "decreasing"
