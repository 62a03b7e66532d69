"""Reads the channels of a file by the reader of its format."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import BinaryIO

import pyarrow as pa
from pyarrow import parquet

from ...text.escaping import one_line
from ..container.suffixes import TABLES
from .csv_file import read_csv
from .given_channel import Channel
from .hdf5_file import read_hdf5
from .mat_file import read_mat
from .npz_file import read_npz
from .tdms_file import read_tdms
from .wav_file import read_wav

_LONGEST_REASON = 200  # characters


def read_given(path: Path) -> list[Channel]:
    """Read the channels of a file.

    Args:
        path: of a table (see `is_table`), NumPy archive or MCAP recording.

    Raises:
        ValueError: the file is not one of its format; the message begins with its path.
        OSError: it cannot be read.
    """
    reader = _READERS.get(path.suffix.lower(), _read_recording if path.is_dir() else None)
    if reader is None:
        raise ValueError(f"{path}: {TABLES}")
    if path.exists() and not path.is_file() and reader is not _read_recording:
        raise ValueError(f"{path}: must be a file")
    try:
        return reader(path)
    except UnicodeDecodeError as reason:
        raise ValueError(f"{path}: must be in UTF-8, byte {reason.start + 1} is not") from None
    except (pa.ArrowException, OSError) as reason:
        if isinstance(reason, OSError) and reason.errno is not None:  # of the system, not of Arrow
            raise
        raise ValueError(f"{path}: {one_line(str(reason), _LONGEST_REASON)}") from None
    except ValueError as reason:
        named = str(reason).startswith(f"{path}: ")
        raise ValueError(str(reason) if named else f"{path}: {reason}") from None


def _read_table(read: Callable[[BinaryIO], pa.Table]) -> Callable[[Path], list[Channel]]:
    """A reader of channels from one of a table of Arrow."""

    def read_channels_of(path: Path) -> list[Channel]:
        with path.open("rb") as stream:
            table = read(stream)
        pairs = zip(table.schema, table.columns, strict=True)
        return [Channel(field.name, values, _unit_of(field)) for field, values in pairs]

    return read_channels_of


def _read_recording(path: Path) -> list[Channel]:
    from .mcap_channels import read_mcap  # with packages that tables do not need

    return read_mcap(path)


def _unit_of(field: pa.Field) -> str | None:
    """Unit in the metadata of a Parquet column."""
    return (field.metadata or {}).get(b"unit", b"").decode(errors="replace") or None


def _read_parquet(stream: BinaryIO) -> pa.Table:
    return parquet.read_table(pa.OSFile(stream.name))  # not `stream`: see `read_csv`


_READERS: dict[str, Callable[[Path], list[Channel]]] = {
    **dict.fromkeys((".csv", ".txt", ".tsv", ".dat"), _read_table(read_csv)),
    ".parquet": _read_table(_read_parquet),
    ".mat": read_mat,
    ".wav": read_wav,
    **dict.fromkeys((".h5", ".hdf5"), read_hdf5),
    ".tdms": read_tdms,
    ".npz": read_npz,
    ".mcap": _read_recording,
}
