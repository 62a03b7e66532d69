"""Labelled data sets of simulated vibration."""
