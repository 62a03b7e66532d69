"""Damage over a duty: a map of runs, sums, and the lives that follow."""
