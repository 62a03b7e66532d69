"""The reports of the simulation in /diagnostics."""
