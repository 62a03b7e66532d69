"""Runs without dynamics: the train turns rigidly with its loads in static equilibrium."""
