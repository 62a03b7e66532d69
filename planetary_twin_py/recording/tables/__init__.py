"""Exports recordings as tables, and imports tables of measurements as recordings."""
