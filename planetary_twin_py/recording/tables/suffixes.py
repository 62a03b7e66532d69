"""File suffixes of the tables that can be read; known without the packages that read them."""

SUFFIXES = (".csv", ".parquet", ".mat")
