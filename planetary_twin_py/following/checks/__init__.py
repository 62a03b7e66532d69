"""Compares readings with the scene, and leaves out what cannot be a measurement."""
