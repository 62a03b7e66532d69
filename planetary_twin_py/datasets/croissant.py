"""Metadata of a data set in the format Croissant 1.1 (MLCommons)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import pyarrow as pa

from .card_texts import LIMITS, USES, description_of
from .columns import SERIES, Column
from .plan import DatasetPlan

CONTEXT: dict[str, Any] = {
    "@language": "en",
    "@vocab": "https://schema.org/",
    "arrayShape": "cr:arrayShape",
    "citeAs": "cr:citeAs",
    "column": "cr:column",
    "conformsTo": "dct:conformsTo",
    "containedIn": "cr:containedIn",
    "cr": "http://mlcommons.org/croissant/",
    "rai": "http://mlcommons.org/croissant/RAI/",
    "data": {"@id": "cr:data", "@type": "@json"},
    "dataType": {"@id": "cr:dataType", "@type": "@vocab"},
    "dct": "http://purl.org/dc/terms/",
    "description": {"@container": "@language"},
    "equivalentProperty": "cr:equivalentProperty",
    "examples": {"@id": "cr:examples", "@type": "@json"},
    "extract": "cr:extract",
    "field": "cr:field",
    "fileProperty": "cr:fileProperty",
    "fileObject": "cr:fileObject",
    "fileSet": "cr:fileSet",
    "format": "cr:format",
    "includes": "cr:includes",
    "isArray": "cr:isArray",
    "isLiveDataset": "cr:isLiveDataset",
    "jsonPath": "cr:jsonPath",
    "key": "cr:key",
    "md5": "cr:md5",
    "name": {"@container": "@language"},
    "parentField": "cr:parentField",
    "path": "cr:path",
    "recordSet": "cr:recordSet",
    "references": "cr:references",
    "regex": "cr:regex",
    "repeated": "cr:repeated",
    "replace": "cr:replace",
    "samplingRate": "cr:samplingRate",
    "sc": "https://schema.org/",
    "separator": "cr:separator",
    "source": "cr:source",
    "subField": "cr:subField",
    "transform": "cr:transform",
}
"""That of the specification."""
SPLITS = {
    "train": "cr:TrainingSplit",
    "validation": "cr:ValidationSplit",
    "test": "cr:TestSplit",
}
"""Kinds of parts, by name."""
PARQUET = "application/x-parquet"


def croissant(
    plan: DatasetPlan, columns: Sequence[Column], files: Mapping[str, str]
) -> dict[str, Any]:
    """Metadata of a data set.

    Args:
        plan: of the data set.
        columns: of its tables.
        files: SHA-256 of its Parquet files, by path in its folder.

    Returns:
        Content of croissant.json.
    """
    spec = plan.spec
    given = {
        "creator": [{"@type": "Person", "name": name} for name in spec.creators],
        "url": spec.url,
        "datePublished": spec.published,
    }
    return {
        "@context": CONTEXT,
        "@type": "sc:Dataset",
        "name": spec.name,
        "description": description_of(plan),
        "conformsTo": [
            "http://mlcommons.org/croissant/1.1",
            "http://mlcommons.org/croissant/RAI/1.0",
        ],
        "license": spec.license,
        "version": spec.version,
        "citeAs": f"@misc{{{spec.name}, title={{{spec.name}}}, version={{{spec.version}}}}}",
        **{name: value for name, value in given.items() if value},
        "keywords": ["vibration", "planetary gearbox", "condition monitoring", "simulated"],
        "rai:dataCollection": "Simulated by planetary_twin_py; spec.yaml gives the same data.",
        "rai:dataCollectionType": "Software Collection",
        "rai:dataUseCases": list(USES),
        "rai:dataLimitations": list(LIMITS),
        "distribution": [_file(path, digest) for path, digest in files.items()],
        "recordSet": [_splits(files), *_record_sets(columns, files)],
    }


def _file(path: str, digest: str) -> dict[str, Any]:
    return {
        "@type": "cr:FileObject",
        "@id": path,
        "name": path,
        "contentUrl": path,
        "encodingFormat": PARQUET,
        "sha256": digest,
    }


def split_of(path: str) -> str | None:
    """Part of the data set in a file, by its path; None for the table without samples."""
    return next((name for name in SPLITS if path.startswith(f"data/{name}-")), None)


def _splits(files: Mapping[str, str]) -> dict[str, Any]:
    """The parts as records, which others refer to."""
    found = [name for path in files if (name := split_of(path))]
    names = ("splits/name", "splits/url")
    return {
        "@type": "cr:RecordSet",
        "@id": "splits",
        "name": "splits",
        "dataType": "cr:Split",
        "key": {"@id": names[0]},
        "field": [
            {"@type": "cr:Field", "@id": names[0], "name": "name", "dataType": "sc:Text"},
            {"@type": "cr:Field", "@id": names[1], "name": "url", "dataType": "sc:URL"},
        ],
        "data": [{names[0]: name, names[1]: SPLITS[name]} for name in found],
    }


def _record_sets(columns: Sequence[Column], files: Mapping[str, str]) -> list[dict[str, Any]]:
    """The rows of each file."""
    sets = []
    for path in files:
        split = split_of(path)
        name = "runs" if split is None else split
        own = columns if split is None else (*columns, *SERIES)
        sets.append(
            {
                "@type": "cr:RecordSet",
                "@id": name,
                "name": name,
                "description": "A row for each signal"
                + (", without its samples." if split is None else f" of the part {split}."),
                "key": {"@id": f"{name}/signal_id"},
                "field": [_field(name, path, column) for column in own],
            }
        )
    return sets


def _field(record_set: str, path: str, column: Column) -> dict[str, Any]:
    unit = f" [{column.unit}]" if column.unit else ""
    field: dict[str, Any] = {
        "@type": "cr:Field",
        "@id": f"{record_set}/{column.name}",
        "name": column.name,
        "description": f"{column.text}{unit}",
        "dataType": _kind(column.kind),
        "source": {"fileObject": {"@id": path}, "extract": {"column": column.name}},
    }
    if pa.types.is_list(column.kind):
        field |= {"isArray": True, "arrayShape": "-1"}
    if column.name == "split" and split_of(path):
        field["references"] = {"field": {"@id": "splits/name"}}
    return field


def _kind(kind: pa.DataType) -> str:
    """Type of Croissant of a column."""
    if pa.types.is_list(kind):
        return "cr:Float32" if kind.value_type == pa.float32() else "sc:Float"
    if pa.types.is_boolean(kind):
        return "sc:Boolean"
    if pa.types.is_integer(kind):
        return "sc:Integer"
    return "sc:Text" if pa.types.is_string(kind) else "sc:Float"
