"""MCAP files: records, chunks and indexes, also of truncated or damaged files."""
