"""Follows vibration: which patterns of lines grow."""
