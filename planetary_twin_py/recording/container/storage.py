"""How a recording is laid out on disk."""

from __future__ import annotations

from dataclasses import dataclass

from mcap.writer import CompressionType

COMPRESSIONS = {
    "zstd": CompressionType.ZSTD,
    "lz4": CompressionType.LZ4,
    "none": CompressionType.NONE,
}
CHUNK_SIZES = (0.001, 64.0)  # [MB]; readers must hold a chunk in memory
_MEGABYTE = 1_000_000


@dataclass(frozen=True)
class Storage:
    """Compression of chunks, their size, and when the next file of a bag begins.

    Raises `ValueError` naming the field where a value is none that can be.
    """

    compression: str = "zstd"
    chunk_size: float = 1.0
    """[MB] before compression; a flush ends a chunk early."""
    split_duration: float = 0.0
    """[s] of log time in a file; 0: no limit."""
    split_size: float = 0.0
    """[MB] on disk, which the chunk in progress may exceed; 0: no limit."""

    def __post_init__(self) -> None:
        if self.compression not in COMPRESSIONS:
            known = ", ".join(COMPRESSIONS)
            raise ValueError(f"compression = {self.compression!r}: must be one of {known}")
        least, most = CHUNK_SIZES
        if not least <= self.chunk_size <= most:
            raise ValueError(f"chunk_size = {self.chunk_size}: must be {least:g} to {most:g} MB")
        for name in ("split_duration", "split_size"):
            if not getattr(self, name) >= 0.0:
                raise ValueError(f"{name} = {getattr(self, name)}: must not be negative")

    @property
    def chunk_bytes(self) -> int:
        """Size of a chunk in bytes."""
        return round(self.chunk_size * _MEGABYTE)

    @property
    def longest(self) -> float:
        """Log time that a file spans at most [ns]."""
        return self.split_duration * 1e9 or float("inf")

    @property
    def largest(self) -> float:
        """Bytes after which the next file begins."""
        return self.split_size * _MEGABYTE or float("inf")
