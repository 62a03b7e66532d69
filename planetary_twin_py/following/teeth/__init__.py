"""Finds changed teeth in the transmission error of two encoders."""
