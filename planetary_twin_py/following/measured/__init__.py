"""Readings from messages, recordings and tables."""
