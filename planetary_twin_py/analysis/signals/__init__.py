"""Signals to analyse, from recordings, runs and measured tables."""
