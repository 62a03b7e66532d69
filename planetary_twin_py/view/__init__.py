"""Looking at a recording in Rerun; `show.save` puts together what the other files make.

gears (with motion: solids that turn), plots, waveform and events (curves and changes), quantities
(titles and units), timeline (simulated and ROS time), blueprint (layout), viewer (the window) and
screenshot (a picture without a display).
"""
