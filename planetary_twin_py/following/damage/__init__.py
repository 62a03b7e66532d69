"""Counts the damage of a measured gearbox."""
