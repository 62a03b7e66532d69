"""Looking at recordings in Rerun; `show.save` puts together what the other files make.

gears (with motion: solids that turn) and contacts (tooth pairs that carry), plots, waveform and
events (curves and changes), frames (windows of the DTE) with spectra and phase_portrait, drawn as
a chart, timeline (simulated and ROS time), layer and overlay
(several recordings over one another), live (a running twin), blueprint (layout), viewer (the window
and the page) and screenshot (a picture without a display).
"""
