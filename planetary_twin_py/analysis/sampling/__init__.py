"""Samples in time: equal steps, values between samples, gaps and aliases."""
