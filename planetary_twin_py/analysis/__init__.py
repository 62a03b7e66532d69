"""Signal analysis for gearboxes.

spectrum: amplitude spectrum, power spectral density and lines. orders: computed order tracking.
interpolation: values between samples. even_steps: signals whose time stamps drift. segments:
uniformly sampled segments of a signal. signals: signals of recordings and runs. aliases: detection
of aliasing. mesh_spectrum: spectrum of a mesh, and the harmonics of the mesh frequency.
"""
