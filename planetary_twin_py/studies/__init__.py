"""Many runs of one gearbox: which points to run, what to keep of each, where to run them.

axes (a field and its values, from text), plan (the points), measures (a run in a row of figures),
local and cluster (who runs them), journal (what is done survives a kill), table (what comes out).
fit: parameters from a recording.
"""
