"""Recordings as tables for other tools, and tables of measurements as recordings."""
