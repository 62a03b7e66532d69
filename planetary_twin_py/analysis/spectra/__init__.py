"""Spectra and envelopes of uniformly sampled signals."""
