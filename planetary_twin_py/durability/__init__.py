"""Fatigue: cycles of loads, stresses, lives and their sums."""
