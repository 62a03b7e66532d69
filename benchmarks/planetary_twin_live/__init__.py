"""Jitter, latency and cost of a live twin, measured from another process."""
