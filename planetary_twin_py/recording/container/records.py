"""The records of a recording, in file order; needs no ROS.

A recording is an MCAP file, or a bag folder with one or several. The intact parts of a file that is
damaged, or truncated by a killed logger, are read, with a warning about the rest. Checksums are
always verified.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from mcap.records import Attachment, Channel, Message, Metadata, Schema
from mcap.stream_reader import StreamReader

from ...text.escaping import one_line
from .bag_folder import how_stored, missing_files
from .damage import Damages
from .framing import LONGEST_RECORD, opened, piece_at
from .integrity import MAGIC, end_of_data, start_of_summary
from .suffixes import TABLES
from .walk import Sound, walk

_LONGEST_MESSAGE = 900  # characters


class RecordingError(ValueError):
    """The path is not a recording of a gearbox; the message gives the reason in one line.

    Text from the file, such as the name of a topic, cannot break that line.
    """

    def __init__(self, text: str) -> None:
        super().__init__(one_line(text, _LONGEST_MESSAGE))


class Section(NamedTuple):
    """The records of one chunk, or a single record outside; `place` is the position in the file."""

    place: int
    records: list[Any]


def files_of(path: Path, remarks: list[str] | None = None) -> list[Path]:
    """The MCAP files of the recording at `path`, in order.

    Args:
        path: path of an MCAP file, or of a folder of them.
        remarks: a line is appended if files of the folder are missing.

    Raises:
        RecordingError: there is no MCAP file.
    """
    if not path.exists():
        raise RecordingError(f"{path}: no such file or folder")
    if not (path.is_dir() or path.is_file()):
        raise RecordingError(f"{path}: neither a file nor a folder")
    if stored := how_stored(path):
        raise RecordingError(f"{path}: {stored}")
    if not path.is_dir():
        return [path]
    found = (file for file in path.glob("*.mcap") if file.is_file())
    files = sorted(found, key=lambda file: (len(file.name), file.name))
    if not files:
        raise RecordingError(f"{path}: not a recording: the folder has no .mcap file")
    if remarks is not None and (missing := missing_files(path, {file.name for file in files})):
        remarks.append(f"{path}: {missing}")
    return files


def records_of(file: Path, remarks: list[str]) -> Iterator[Any]:
    """All intact schemas, channels, messages, attachments and metadata.

    A line is appended to `remarks` for each damaged part.

    Yields:
        Records of `mcap`, in file order.

    Raises:
        RecordingError: nothing can be read.
    """
    for section in sections_of(file, remarks):
        yield from section.records


def sections_of(file: Path, remarks: list[str]) -> Iterator[Section]:
    """All intact records as in `records_of`, section by section."""
    known, damages, end = _Known(file), Damages(file.name), 0
    with file.open("rb") as stream:
        remarks += filter(None, [_begin_remark(file, stream)])
        if stream.seek(0, 2) < len(MAGIC):
            return
        for part in walk(file, stream):
            damages.add(part)
            if isinstance(part, Sound):
                place, records = part.piece.place, known.described(part.records)
                end = part.piece.end
            else:
                place, records = part.place, known.summarised()
            if records:
                yield Section(place, records)
    if damages.unsupported:
        raise RecordingError(f"{file}: {damages.unsupported}")
    remarks += damages.remarks() or filter(None, [_end_remark(file, end)])
    if known.strays:
        remarks.append(
            f"{file.name}: {known.strays} messages are skipped because their channels are lost"
        )


def section_at(file: Path, place: int) -> list[Any]:
    """The records of the section at position `place`; raises one of `DAMAGED` if there is none."""
    with file.open("rb") as stream:
        stream.seek(place)
        return opened(piece_at(stream))


class _Known:
    """Schemas and channels read so far; `strays` counts messages of unknown channels."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._schemas: set[int] = set()
        self._channels: set[int] = set()
        self.strays = 0

    def described(self, records: list[Any]) -> list[Any]:
        """The described ones: channels with their schemas, messages with their channels."""
        return [record for record in records if self._is_described(record)]

    def summarised(self) -> list[Any]:
        """Schemas and channels that occur only in the summary, if it is intact."""
        end = end_of_data(self._file)
        if end is None:
            return []
        with self._file.open("rb") as stream:
            stream.seek(end)
            found = list(StreamReader(stream, True, record_size_limit=LONGEST_RECORD).records)
        schemas = [s for s in found if isinstance(s, Schema) and s.id not in self._schemas]
        channels = [c for c in found if isinstance(c, Channel) and c.id not in self._channels]
        return self.described([*schemas, *channels])

    def _is_described(self, record: Any) -> bool:
        if isinstance(record, Message):
            known = record.channel_id in self._channels
            self.strays += not known
            return known
        if isinstance(record, Schema):
            self._schemas.add(record.id)
        elif isinstance(record, Channel):
            if record.schema_id not in self._schemas:
                return False
            self._channels.add(record.id)
        return isinstance(record, (Schema, Channel, Attachment, Metadata))


def _begin_remark(file: Path, stream: BinaryIO) -> str:
    """Warning about the first bytes of an MCAP file, which its last bytes identify, too.

    Raises:
        RecordingError: it is not an MCAP file.
    """
    first = stream.read(len(MAGIC))
    if first == MAGIC:
        return ""
    if MAGIC.startswith(first):
        return f"{file.name}: ends after {len(first)} bytes, before any message"
    stream.seek(-len(first), 2)
    if stream.read() != MAGIC:
        raise RecordingError(f"{file}: not a recording: not an MCAP file; {TABLES}")
    return f"{file.name}: its first {len(MAGIC)} bytes are damaged"


def _end_remark(file: Path, end: int) -> str:
    """Warning about what follows the data, which end at position `end`; empty if it is intact."""
    if start_of_summary(file) is not None:
        return ""
    with file.open("rb") as stream:
        size = stream.seek(0, 2)
        stream.seek(max(size - len(MAGIC), end))
        if stream.read() == MAGIC:
            return f"{file.name}: its summary is damaged"
    return (
        f"{file.name}: is truncated, the last {size - end} of {size} bytes are unreadable; "
        "everything before is intact"
    )
