"""Signal analysis for gearboxes; the rooms from the ground to the top.

sampling: uniform samples. spectra: spectrum, envelope, cepstrum. shaft: angles, and spectra over
orders. signals: what is analysed, from recordings, runs and measured tables. lines: lines of a
spectrum and their names. gears: averages of a gear and its condition. faults: where faults have
lines.
"""
