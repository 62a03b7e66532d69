"""Angles of shafts, and signals over angle and order."""
