"""Other programs open a data set: pandas, mlcroissant, and what Hugging Face reads."""

import json

import numpy as np
import pyarrow.parquet as parquet
import pytest
import yaml
from datasets.small import plan_of, written

from planetary_twin_py.datasets.columns import SERIES, table_columns

mlcroissant = pytest.importorskip("mlcroissant")  # see `make test-cosimulation`
pandas = pytest.importorskip("pandas")

PARTS = {"train": 9, "validation": 3, "test": 3}


@pytest.fixture(scope="module")
def small(tmp_path_factory):
    folder = tmp_path_factory.mktemp("small")
    plan = plan_of(folder, published='"2026-11-30"', creators="[A. Maker]")
    written(plan, folder / "set")
    return plan, folder / "set"


def test_croissant_metadata_are_valid_and_give_the_records(small):
    _, folder = small
    found = mlcroissant.Dataset(folder / "croissant.json")
    assert not found.metadata.ctx.issues.errors and not found.metadata.ctx.issues.warnings
    for part, count in PARTS.items():
        rows = list(found.records(part))
        table = parquet.read_table(folder / "data" / f"{part}-00000-of-00001.parquet").to_pylist()
        assert len(rows) == count
        for row, own in zip(rows, table, strict=True):
            assert row[f"{part}/native_label"].decode() == own["native_label"]
            assert np.array_equal(row[f"{part}/samples"], own["samples"])
    assert [row["splits/name"] for row in found.records("splits")] == list(PARTS)
    assert len(list(found.records("runs"))) == 15


def test_croissant_metadata_have_digests_and_limits(small):
    _, folder = small
    about = json.loads((folder / "croissant.json").read_text())
    listed = dict(
        line.split("  ")[::-1] for line in (folder / "checksums.txt").read_text().splitlines()
    )
    files = {file["@id"]: file["sha256"] for file in about["distribution"]}
    assert files.keys() == {name for name in listed if name.endswith(".parquet")}
    assert files.items() <= listed.items()
    assert about["conformsTo"][0] == "http://mlcommons.org/croissant/1.1"
    assert any(
        "not been shown to work on a machine" in line for line in about["rai:dataLimitations"]
    )


def test_the_card_leads_to_the_parts_as_hugging_face_reads_it(small):
    _, folder = small
    _, header, text = (folder / "README.md").read_text().split("---\n", 2)
    about = yaml.safe_load(header)
    default, runs = about["configs"]
    for part in default["data_files"]:
        (path,) = folder.glob(part["path"])
        table = parquet.read_table(path)
        assert len(table) == PARTS[part["split"]]
        assert set(table["split"].to_pylist()) == {part["split"]}
    assert len(parquet.read_table(folder / runs["data_files"])) == 15
    assert about["size_categories"] == ["n<1K"] and about["license"] == "cc-by-4.0"
    assert "| train | 3 | 3 | 3 | 3 |" in text


def test_pandas_reads_types_and_units_are_in_the_schema(small):
    plan, folder = small
    path = folder / "data" / "train-00000-of-00001.parquet"
    frame = pandas.read_parquet(path)
    assert frame["samples"][0].dtype == np.float32 and len(frame["samples"][0]) == 250
    assert frame["fault_severity"].dtype == np.float64
    schema = parquet.read_schema(path)
    assert schema.names == [column.name for column in (*table_columns(plan), *SERIES)]
    assert schema.field("mesh.sun_planet_stiffness").metadata[b"unit"] == b"N/m"
