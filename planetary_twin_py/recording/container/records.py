"""The records of a recording, in file order; needs no ROS.

A recording is an MCAP file, or a bag folder with one or several. The intact parts of a file that is
damaged, or truncated by a killed logger, are read, with a warning about the rest. Checksums are
always verified.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any, BinaryIO, NamedTuple

from mcap.exceptions import McapError
from mcap.opcode import Opcode
from mcap.records import Channel, DataEnd, Message, Schema
from mcap.stream_reader import CRCValidationError

from ...text.escaping import one_line
from .damage import Damages
from .foreign import how_stored
from .framing import DAMAGED, opened, piece_at
from .integrity import MAGIC, damaged_summary, end_of_data
from .missing_files import missing_files
from .suffixes import TABLES
from .walk import Lost, Sound, Walk

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

    Args:
        file: MCAP file.
        remarks: a line is appended for each damaged part.

    Yields:
        Records of `mcap`, in file order.

    Raises:
        RecordingError: nothing can be read.
    """
    for section in sections_of(file, remarks):
        yield from section.records


def sections_of(file: Path, remarks: list[str]) -> Iterator[Section]:
    """All intact records as in `records_of`, section by section."""
    known, damages, ended, end_remark = _Known(file), Damages(file), False, ""
    with file.open("rb") as stream:
        remarks += _begin_remarks(file, stream)
        if stream.tell() < len(MAGIC):
            return
        for step in Walk(file, stream):
            if isinstance(step, Sound):
                damages.add_sound(step)
                ended = ended or step.piece.opcode == Opcode.DATA_END  # the rest only repeats
                place, records = step.piece.place, [] if ended else known.described(step.records)
            elif isinstance(step, Lost):
                damages.add_lost(step)
                place, records = step.place, known.summarised()
            else:
                end_remark = _damage_after_data(file, damages.reached, step)
                break
            if records:
                yield Section(place, records)
        end_remark = end_remark or _end_remark(file, ended)
    if damages.unsupported:
        raise RecordingError(f"{file}: {damages.unsupported}")
    remarks += damages.remarks() or filter(None, [end_remark])
    if known.strays:
        remarks.append(
            f"{file.name}: {known.strays} messages are skipped because their channels are lost"
        )


class _Known:
    """Schemas and channels read so far; `strays` counts messages of unknown channels."""

    def __init__(self, file: Path) -> None:
        self._file = file
        self._schemas: set[int] = set()
        self._channels: set[int] = set()
        self.strays = 0

    def described(self, records: list[Any]) -> list[Any]:
        """`records` without channels that lack a schema, and messages that lack a channel."""
        return [record for record in records if self._is_described(record)]

    def summarised(self) -> list[Any]:
        """Schemas and channels that occur only in the summary, if it is intact."""
        found = _summary(self._file)
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
        return True


def _summary(file: Path) -> list[Any]:
    """The schemas and channels of an intact summary."""
    records: list[Any] = []
    end = end_of_data(file)
    if end is None:
        return records
    with file.open("rb") as stream:
        stream.seek(end)
        try:
            while (piece := piece_at(stream)).opcode != Opcode.FOOTER:
                records += opened(piece)
        except DAMAGED:
            pass  # the writer of the summary made an error that its checksum does not show
    return records


def _begin_remarks(file: Path, stream: BinaryIO) -> list[str]:
    """Warnings about the first bytes of an MCAP file, which its header or its end identifies.

    A killed writer may leave a file without these bytes.

    Raises:
        RecordingError: it is not an MCAP file.
    """
    first = stream.read(len(MAGIC))
    if first == MAGIC:
        return []
    if MAGIC.startswith(first):
        return [f"{file.name}: ends after {len(first)} bytes, before any message"]
    try:
        is_mcap = opened(header := piece_at(stream)) == [] and header.opcode == Opcode.HEADER
    except DAMAGED:
        is_mcap = stream.seek(0, 2) > len(MAGIC) and end_of_data(file) is not None
    if not is_mcap:
        raise RecordingError(f"{file}: not a recording: not an MCAP file; {TABLES}")
    return [f"{file.name}: its first {len(MAGIC)} bytes are damaged"]


def _end_remark(file: Path, ended: bool) -> str:
    """Warning about the end of a file that is not truncated; empty if there is none."""
    if not ended:
        return f"{file.name}: has no Data End record; data may be missing"
    return f"{file.name}: its summary is damaged" if damaged_summary(file) else ""


def _damage_after_data(file: Path, sound: int, reason: Exception) -> str:
    """Warning about damage after the data, or a wrong checksum of the data."""
    if isinstance(reason, CRCValidationError) and isinstance(reason.record, DataEnd):
        return f"{file.name}: its data fail their checksum: they may be wrong or incomplete"
    size = file.stat().st_size
    return (
        f"{file.name}: is truncated, the last {size - sound} of {size} bytes "
        f"are unreadable ({type(reason).__name__}); everything before is intact"
    )


def section_at(file: Path, place: int) -> list[Any]:
    """The records of the section at position `place`, from `sections_of`."""
    with file.open("rb") as stream:
        stream.seek(place)
        return opened(piece_at(stream))


def chunk_at(file: Path, place: int) -> list[Any]:
    """The records of the chunk at position `place`; raises one of `DAMAGED` if there is none."""
    with file.open("rb") as stream:
        stream.seek(place)
        piece = piece_at(stream)
    if piece.opcode != Opcode.CHUNK:
        raise McapError(f"no chunk at {place}")
    return opened(piece)
