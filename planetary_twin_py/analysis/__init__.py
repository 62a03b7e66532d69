"""Signal analysis for gearboxes.

spectrum: amplitude spectrum, power spectral density and lines. orders: computed order tracking.
interpolation: values between samples. even_steps: signals whose time stamps drift. segments:
uniformly sampled segments of a signal. signals: signals of recordings and runs. aliases: detection
of aliasing. mesh_spectrum: spectrum of a mesh, and the harmonics of the mesh frequency. tachometer,
tacholess: angles. synchronous_average, planet_separation: averages of a gear. gear_signals,
mesh_band, indicators, block_intervals, gear_condition: its condition. envelope, cepstrum,
spectral_kurtosis: impacts. turning, fault_lines, bearing_orders, coincidences, shared_lines,
fault_orders: where faults have lines. shaft_angle, sensor: signals of measured tables.
averaged_spectrum: several records. separated_condition: condition of one planet. waveform_map,
imported_waveforms: measured waveforms as a recording.
"""
