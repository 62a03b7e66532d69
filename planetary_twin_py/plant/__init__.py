"""Simulated plant with a known ground truth: a gearbox that changes, and sensors with errors."""
