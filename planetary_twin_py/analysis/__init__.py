"""Signal analysis as people use it on gearboxes: spectra and orders.

spectrum (amplitude spectrum, power spectral density, lines), orders (computed order tracking),
stretches (where samples follow one another evenly), signals (what to analyse of a recording).
"""
