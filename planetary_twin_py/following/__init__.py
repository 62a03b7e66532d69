"""Estimates the state of a measured gearbox, and reports what the readings do not determine."""
