"""Files whose contents are much larger than they are refused before they take memory."""

import io
import resource
import subprocess
import sys
import time
import zipfile
import zlib

import numpy as np
import pyarrow as pa
import pytest
from pyarrow import parquet
from scipy.io import savemat

from planetary_twin_py.recording.tables.measurements import read_columns
from planetary_twin_py.recording.tables.unpacking import MOST_ADDED

LARGEST = 300.0  # [MB] of memory until a file is refused
LONGEST = 2.0  # [s] of processor

# What a process takes for the file beyond what its imports take.
READ = """
import resource, sys
from pathlib import Path
import scipy.io
from planetary_twin_py.analysis.signals import read_signal
from planetary_twin_py.recording.tables.measurements import read_columns

def used():
    found = resource.getrusage(resource.RUSAGE_SELF)
    return found.ru_maxrss / 1e3, found.ru_utime + found.ru_stime

path = Path(sys.argv[1])
memory, seconds = used()
try:
    read_signal(path, "sun_planet_1", "dte") if path.suffix == ".npz" else read_columns(path)
except ValueError as reason:
    print(reason)
after = used()
print(after[0] - memory, after[1] - seconds)
"""


def of_mat(path, kind, number):
    """A vector that states `number` zeros, in bytes or in doubles, and has 16 MB of them."""
    plain = io.BytesIO()
    savemat(plain, {"time": np.zeros(16, kind)})
    header, element = plain.getvalue()[:128], bytearray(plain.getvalue()[128:])
    size = np.dtype(kind).itemsize
    begin = len(element) - 16 * size - 4
    element = element[:begin] + np.uint32(number * size).tobytes()
    shape = element.index(np.int32([1, 16]).tobytes())
    element[shape : shape + 8] = np.int32([1, number]).tobytes()
    element[4:8] = np.uint32(len(element) - 8 + number * size).tobytes()
    packed = zlib.compress(bytes(element) + bytes(2**24))
    path.write_bytes(header + np.uint32([15, len(packed)]).tobytes() + packed)


def of_parquet(path, number):
    """A column of one number, which a run of it describes."""
    with parquet.ParquetWriter(path, pa.schema({"time": pa.float64()})) as writer:
        column = pa.array(np.zeros(2**22))
        for _ in range(number // 2**22):
            writer.write_table(pa.table({"time": column}), row_group_size=2**22)


def of_npz(path, number):
    """A member of zeros."""
    with (
        zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive,
        archive.open("time.npy", "w", force_zip64=True) as member,
    ):
        header = {"descr": "<f8", "fortran_order": False, "shape": (number,)}
        np.lib.format.write_array_header_1_0(member, header)
        for _ in range(number // 2**17):
            member.write(bytes(2**20))


@pytest.mark.parametrize(
    ("name", "write"),
    [
        pytest.param(
            "doubles.mat",
            lambda path: of_mat(path, "f8", MOST_ADDED // 8 + 2**20),
            marks=pytest.mark.exhaustive,
        ),
        ("bytes.mat", lambda path: of_mat(path, "u1", MOST_ADDED // 8 + 2**20)),
        pytest.param(
            "runs.parquet",
            lambda path: of_parquet(path, MOST_ADDED // 8 + 2**23),
            marks=pytest.mark.exhaustive,
        ),
        pytest.param(
            "members.npz",
            lambda path: of_npz(path, MOST_ADDED // 8 + 2**20),
            marks=pytest.mark.exhaustive,
        ),
    ],
)
def test_contents_that_grow_too_much_are_refused_in_one_line(tmp_path, name, write):
    path = tmp_path / name
    write(path)
    assert path.stat().st_size < 1e7
    command = [sys.executable, "-c", READ, str(path)]
    found = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    reason, figures = found.splitlines()
    assert str(path) in reason and "may add at most 1074 MB" in reason
    memory, seconds = map(float, figures.split())
    assert memory < LARGEST
    assert seconds < LONGEST


def test_a_variable_that_states_less_than_it_holds_takes_what_it_states(tmp_path):
    path = tmp_path / "less.mat"
    of_mat(path, "f8", 2**20)
    data = path.read_bytes()
    element = bytearray(zlib.decompress(data[136:]))
    assert len(element) > 2**23
    element[4:8] = np.uint32(4096).tobytes()
    packed = zlib.compress(bytes(element))
    path.write_bytes(data[:128] + np.uint32([15, len(packed)]).tobytes() + packed)
    with pytest.raises(ValueError, match="not a MAT file"):
        read_columns(path)


@pytest.mark.parametrize("compressed", [False, True])
def test_all_vectors_of_a_mat_file_are_read(tmp_path, compressed):
    path, time_stamps = tmp_path / "vectors.mat", np.linspace(0.0, 1.0, 1000)
    contents = {"time": time_stamps, "speed": np.arange(1000), "name": "rig", "nested": {"a": 1.0}}
    savemat(path, contents, do_compression=compressed)
    columns = read_columns(path)
    assert list(columns) == ["time", "speed"]
    assert np.array_equal(columns["time"].values.to_numpy(), time_stamps)
    assert np.array_equal(columns["speed"].values.to_numpy(), np.arange(1000))


def test_long_texts_that_repeat_take_memory_once_and_are_shown_short(tmp_path):
    path, rows = tmp_path / "texts.parquet", 100_000
    text = pa.DictionaryArray.from_arrays(np.zeros(rows, np.int32), ["x" * 100_000])
    table = pa.table({"time": np.arange(rows, dtype=float), "input_torque": text})
    parquet.write_table(table, path, store_schema=False)
    before = time.process_time()
    column = read_columns(path)["input_torque"]
    with pytest.raises(ValueError, match=r"row 1: input_torque = 'xx.* ... .*': must be a number"):
        column.in_si("input_torque", "N m")
    assert time.process_time() - before < LONGEST
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss < 2e6  # kB; the texts have 10 GB


@pytest.mark.parametrize(
    "kind", [pa.string(), pa.large_string(), pa.string_view(), pa.binary(), pa.large_binary()]
)
def test_texts_of_every_type_take_memory_once(tmp_path, kind):
    path, rows = tmp_path / "texts.parquet", 20_000
    text = "x" * 5000 if "string" in str(kind) else b"x" * 5000
    table = pa.table({"time": np.arange(rows, dtype=float), "label": pa.array([text] * rows, kind)})
    parquet.write_table(table, path)
    values = read_columns(path)["label"].values
    assert values[rows - 1].as_py() == text
    assert values.nbytes < 1e6


def test_columns_of_bytes_of_a_fixed_size_are_refused(tmp_path):
    path = tmp_path / "bytes.parquet"
    bytes_ = pa.array([b"x" * 5000] * 2, pa.binary(5000))
    parquet.write_table(pa.table({"time": [0.0, 1.0], "speed": bytes_}), path)
    with pytest.raises(ValueError, match=r"column 'speed': must be numbers, not fixed_size_binary"):
        read_columns(path)


def test_columns_of_lists_are_refused(tmp_path):
    path = tmp_path / "lists.parquet"
    parquet.write_table(pa.table({"time": [0.0, 1.0], "speed": [[1.0], [2.0, 3.0]]}), path)
    with pytest.raises(ValueError, match=r"column 'speed.*': must be numbers, not lists"):
        read_columns(path)
