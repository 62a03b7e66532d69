"""Results of a study as a tidy table: a row per point, a column per quantity.

The metadata of a column have its unit and description, those of the table its scene and settings.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.csv
import pyarrow.parquet

from ..scene.quantity import unit_of
from ..units.catalogue import AXES_RESULTS, STUDY_RESULTS, Quantity
from .axes import look_up
from .plan import BIFURCATION, Study
from .work import Failure, Found


def tabulate(study: Study, found: Mapping[int, Found]) -> pa.Table:
    """Tabulate the results of a study.

    Args:
        study: the points.
        found: result or failure by the index of the point.

    Returns:
        A row per point; the column `failure` has the reason of missing values.
    """
    rows = [found[point.place] for point in study.points]
    columns: list[tuple[pa.Field, Any]] = [
        column("point", [point.place for point in study.points], "", "index of the point", "i8")
    ]
    first = study.scene.replace(**study.points[0].changes)  # has the optional sections
    for field in study.fields:
        info, _ = look_up(first, field)
        values = [point.changes[field] for point in study.points]
        columns.append(column(field, values, unit_of(info) or "", info.description or ""))
    for name, quantity in _results(rows).items():
        figures = [None if isinstance(row, Failure) else row.get(name) for row in rows]
        columns.append(column(name, figures, quantity.si, quantity.text, "f8"))
    reasons = [row.reason if isinstance(row, Failure) else None for row in rows]
    columns.append(column("failure", reasons, "", "why there are no results", "str"))
    about = {
        "scene": json.dumps(study.scene.model_dump(mode="json")),
        "settings": json.dumps(asdict(study.settings)),
    }
    schema = pa.schema([field for field, _ in columns], about)
    return pa.table([array for _, array in columns], schema)


def _results(rows: list[Found]) -> dict[str, Quantity]:
    """Quantities of the results: those of axes only if they move somewhere in the study."""
    moving = any(not isinstance(row, Failure) and AXES_RESULTS.keys() <= row.keys() for row in rows)
    return STUDY_RESULTS | (AXES_RESULTS if moving else {})


def write(table: pa.Table, path: Path) -> None:
    """Write a table, atomically.

    Args:
        table: table from `tabulate`.
        path: file ending in .csv or .parquet.

    Raises:
        OSError: the file cannot be written.
    """
    part = path.with_name(f".{path.name}.part")
    if path.suffix == ".csv":
        pyarrow.csv.write_csv(
            table.rename_columns([_heading(field) for field in table.schema]), part
        )
    else:
        pyarrow.parquet.write_table(table, part)
    part.replace(path)


def read(path: Path) -> pa.Table:
    """Read a table that `write` has written.

    Args:
        path: file ending in .csv or .parquet.

    Returns:
        The table; from .csv without descriptions, scene and settings.

    Raises:
        OSError: the file cannot be read.
        ValueError: the file is not the table of a study.
    """
    if path.suffix == ".csv":
        return _read_csv(path)
    try:
        return pyarrow.parquet.read_table(path)
    except pa.ArrowInvalid:
        raise ValueError("not a readable Parquet file") from None


def _read_csv(path: Path) -> pa.Table:
    # An empty cell is null, NaN is a number.
    options = pyarrow.csv.ConvertOptions(null_values=[""], strings_can_be_null=True)
    table = pyarrow.csv.read_csv(path, convert_options=options)
    marks = {"point": {}, "direction": {"study": BIFURCATION}}  # by the first column
    about = marks.get(table.column_names[0])
    if about is None:
        raise ValueError(f"not the table of a study: first column must be {' or '.join(marks)}")
    fields = [_field(old) for old in table.schema]
    return table.rename_columns([field.name for field in fields]).cast(pa.schema(fields, about))


def _field(old: pa.Field) -> pa.Field:
    """Field with name and unit from a heading of `_heading`; integers become floats."""
    name, _, unit = old.name.removesuffix("]").partition(" [")
    kind = pa.float64() if pa.types.is_integer(old.type) else old.type
    return pa.field(name, kind, metadata={"unit": unit, "description": ""})


def _heading(field: pa.Field) -> str:
    """Name with the unit, for CSV."""
    unit = field.metadata[b"unit"].decode()
    return f"{field.name} [{unit}]" if unit else field.name


_TYPES = {"i8": pa.int64(), "f8": pa.float64(), "str": pa.string()}


def column(
    name: str, values: Any, unit: str, description: str, kind: str | None = None
) -> tuple[pa.Field, pa.Array]:
    """Make a column of a table.

    Args:
        name: name of the column.
        values: (n,); None is null.
        unit: SI unit; empty for a dimensionless number or a text.
        description: description of the quantity.
        kind: "i8", "f8" or "str"; None infers the type from the values.

    Returns:
        The field with its metadata, and the array.
    """
    array = pa.array(values, _TYPES[kind] if kind else None)
    about = {"unit": unit, "description": description}
    return pa.field(name, array.type, metadata=about), array
