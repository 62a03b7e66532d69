"""MCAP files: their records, chunks and indexes, also where a file is torn or damaged."""
