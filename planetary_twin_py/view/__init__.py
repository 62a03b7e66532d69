"""Looking at a recording in Rerun; `show.save` puts together what the other files make.

gears (with motion: solids that turn) and contacts (tooth pairs that carry), plots, waveform and
events (curves and changes), frames (windows of the DTE) with spectra and phase_portrait, drawn as
a chart, quantities (titles and units), timeline (simulated and ROS time), blueprint (layout),
viewer (the window) and screenshot (a picture without a display).
"""
