"""Devices of many samples, a file for each: its messages, its tables, and what follows it."""
