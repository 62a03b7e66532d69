"""File suffixes of readable tables; importing them does not import the packages for reading."""

SUFFIXES = (".csv", ".parquet", ".mat")
