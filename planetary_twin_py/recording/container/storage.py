"""Storage options of a recording."""

from __future__ import annotations

from dataclasses import dataclass

COMPRESSIONS = ("zstd", "lz4", "none")
CHUNK_SIZES = (0.001, 64.0)  # [MB]; readers keep a chunk in memory
_MEGABYTE = 1_000_000


@dataclass(frozen=True)
class Storage:
    """Compression and size of chunks, limits at which a bag is split, and time between flushes.

    Raises:
        ValueError: a value is out of range; the message names the field.
    """

    compression: str = "zstd"
    chunk_size: float = 1.0
    """[MB] before compression; a flush ends a chunk early."""
    split_duration: float = 0.0
    """Log time per file [s]; 0: no limit."""
    split_size: float = 0.0
    """Size of a file [MB], which the last chunk may exceed; 0: no limit."""
    flush_period: float = 0.0
    """Log time [s] that messages on their way to the disk cover at most; 0: no limit."""

    def __post_init__(self) -> None:
        if self.compression not in COMPRESSIONS:
            known = ", ".join(COMPRESSIONS)
            raise ValueError(f"compression = {self.compression!r}: must be one of {known}")
        least, most = CHUNK_SIZES
        if not least <= self.chunk_size <= most:
            raise ValueError(f"chunk_size = {self.chunk_size}: must be {least:g} to {most:g} MB")
        for name in ("split_duration", "split_size", "flush_period"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} = {getattr(self, name)}: must not be negative")

    @property
    def chunk_bytes(self) -> int:
        """Size of a chunk in bytes."""
        return round(self.chunk_size * _MEGABYTE)

    @property
    def longest(self) -> float:
        """Largest log time of a file [ns]."""
        return self.split_duration * 1e9 or float("inf")

    @property
    def unflushed(self) -> float:
        """Log time of messages after which they are flushed [ns]."""
        return self.flush_period * 1e9 or float("inf")

    @property
    def largest(self) -> float:
        """Size after which the next file starts [bytes]."""
        return self.split_size * _MEGABYTE or float("inf")
