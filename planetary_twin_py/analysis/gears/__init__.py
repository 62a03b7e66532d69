"""Averages of one gear, and indicators of its condition."""
