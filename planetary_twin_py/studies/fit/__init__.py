"""Estimation of scene parameters from a recording, with identifiability analysis.

parameter: the free parameters. excerpt: the part of the recording that is used. readings: the
measured quantities in it. model: the same quantities from a simulation. misfit: noise and weighted
residuals. least_squares: minimisation. intervals: confidence intervals. identifiability:
parameters that the readings do not determine. identify: the complete procedure.
"""
