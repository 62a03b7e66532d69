"""Parameters of a gearbox from a recording of it, and what the recording cannot tell.

parameter (what is free), stretch (which part of the recording), readings (what a rig would have
measured of it), model (parameters in, the same readings out), misfit (how far apart, in units of
the noise), least_squares (where that is least), intervals (how far the truth may lie from there),
identifiability (what the readings do not tell), identify (all of it in its order).
"""
