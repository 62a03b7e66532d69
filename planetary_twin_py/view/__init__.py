"""Recordings and running twins in Rerun; `show.save` combines the other modules.

gears, motion: rotating solids. contacts: loaded tooth pairs. plots, waveform, events: curves and
parameter changes. frames, spectra, phase_portrait: plots over windows of the DTE, orbits: of axes,
chart: their axes. timeline: simulated and ROS time. layer, overlay: several recordings together.
live: a running twin. blueprint: layout. viewer: window and web page. screenshot: pictures without a
display.
"""
