"""Pages of Parquet files: their sizes are those that pyarrow writes, and lies are refused."""

import io
import resource
import struct

import numpy as np
import pyarrow as pa
import pytest
import zstandard
from pyarrow import parquet

from planetary_twin_py.recording.tables import parquet_pages
from planetary_twin_py.recording.tables.measurements import read_columns
from planetary_twin_py.recording.tables.parquet_pages import PageError, read_page, unpacked_size
from planetary_twin_py.recording.tables.unpacking import MOST_ADDED

ROWS = 10_000
SKIPPABLE = 0x184D2A50  # first of the frames that Zstandard ignores


def varint(value, least=1):
    """A number of Thrift's compact protocol, in `least` bytes or more."""
    found = bytearray()
    while value or len(found) < least:
        found.append(value & 127 | 128)
        value >>= 7
    found[-1] &= 127
    return bytes(found)


def field(value, least=1):
    """The next field of a structure, a number of 32 bits."""
    return b"\x15" + varint(value << 1 ^ value >> 63, least)


def header(unpacked, packed, values):
    """Header of a page of plain values, always as long."""
    of_data = field(values, 5) + field(0) + field(3) + field(3) + b"\0"
    return field(0) + field(unpacked, 5) + field(packed, 5) + b"\x2c" + of_data + b"\0"


def lying(path, unpacked, stated):
    """A column whose only page holds so many zeros [B] and states another size, or the same."""
    packed = io.BytesIO()
    with zstandard.ZstdCompressor().stream_writer(packed, closefd=False) as writer:
        for _ in range(unpacked // 2**20):
            writer.write(bytes(2**20))
    values = len(packed.getvalue()) // 8 + 100
    column = {"time": np.random.default_rng(0).standard_normal(values)}  # of which no byte is saved
    plain = {"use_dictionary": False, "write_statistics": False, "compression": "zstd"}
    parquet.write_table(pa.table(column), path, data_page_size=2**30, **plain)
    chunk = parquet.read_metadata(path).row_group(0).column(0)
    begin, size = chunk.data_page_offset, chunk.total_compressed_size
    assert chunk.total_uncompressed_size < 2 * size
    head = header(stated, size - len(header(0, 0, 0)), values)
    left = size - len(head) - len(packed.getvalue())
    filling = struct.pack("<II", SKIPPABLE, left - 8) + bytes(left - 8)
    data = path.read_bytes()
    path.write_bytes(
        data[:begin] + head + packed.getvalue() + filling + data[begin + size :],
    )


@pytest.mark.parametrize("version", ["1.0", "2.0"])
@pytest.mark.parametrize("compression", ["none", "zstd", "snappy"])
@pytest.mark.parametrize("dictionary", [False, True])
def test_sizes_are_those_of_the_metadata(tmp_path, version, compression, dictionary):
    path = tmp_path / "table.parquet"
    columns = {
        "time": np.arange(ROWS) * 1e-3,
        "text": [f"value {k % 7}" for k in range(ROWS)],
        "holes": [None if k % 3 else float(k) for k in range(ROWS)],
    }
    parquet.write_table(
        pa.table(columns), path, row_group_size=3000, data_page_size=1000,
        use_dictionary=dictionary, compression=compression, data_page_version=version,
        write_page_checksum=True,
    )  # fmt: skip
    metadata = parquet.read_metadata(path)
    with path.open("rb") as stream:
        found = unpacked_size(stream, metadata)
    groups = [metadata.row_group(k) for k in range(metadata.num_row_groups)]
    columns_ = [group.column(k) for group in groups for k in range(3)]
    with_headers = sum(column.total_uncompressed_size for column in columns_)
    assert 0.5 * with_headers < found < with_headers
    if compression == "none":
        packed = sum(column.total_compressed_size for column in columns_)
        assert packed == with_headers  # so the walk has met the end of every chunk


@pytest.mark.parametrize("stated", [MOST_ADDED + 2**20, 2**31 - 1])
def test_a_page_that_states_gigabytes_is_refused_before_it_takes_memory(tmp_path, stated):
    path = tmp_path / "lie.parquet"
    lying(path, 2**26, stated)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(ValueError, match=r"lie.parquet: unpacks from .* may add at most 1074 MB"):
        read_columns(path)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 1e5  # kB


def test_a_long_statistic_in_a_header_is_skipped(tmp_path):
    path, text = tmp_path / "texts.parquet", "x" * 100_000
    table = pa.table({"time": [0.0, 1.0], "label": [text, text]})
    parquet.write_table(table, path, use_dictionary=False)
    assert read_columns(path)["label"].values[1].as_py() == text


def test_a_file_of_very_many_pages_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(parquet_pages, "MOST_PAGES", 20)
    path = tmp_path / "pages.parquet"
    parquet.write_table(pa.table({"time": np.arange(30.0)}), path, row_group_size=1)
    with pytest.raises(ValueError, match="has more than 20 pages"):
        read_columns(path)


@pytest.mark.parametrize("stated", [2**10, 2**26])
def test_a_page_that_holds_more_than_its_values_takes_what_it_states(tmp_path, stated):
    path = tmp_path / "lie.parquet"
    lying(path, 2**26, stated)
    with pytest.raises(ValueError, match=r"lie.parquet: ") as refusal:
        read_columns(path)["time"].in_si("time", "s")
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize(
    ("data", "reason"),
    [
        (b"", "damaged"),
        (b"\0", "damaged"),
        (field(0) + field(5), "damaged"),
        (header(5, -1, 1), "states -1 bytes"),
        (field(0) + b"\x15" + b"\xff" * 11, "more than 64 bits"),
        (b"\x1c" * 20, "too many levels"),
        (b"\x1f", "field of kind 15"),
        (b"\x18\xff\xff\xff\x7f", "damaged"),
        (b"\x19\xf8\xff\xff\xff\x7f", "damaged"),
    ],
)
def test_what_is_no_header_is_refused(data, reason):
    with pytest.raises(PageError, match=reason):
        read_page(data)
