"""Follows a measured gearbox: what its readings tell of it, and what they cannot."""
