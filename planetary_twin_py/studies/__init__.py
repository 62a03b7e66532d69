"""Parameter studies: many runs of one gearbox.

axes: fields and their values, parsed from text. plan: the points of a study. measures: the results
of one run as a table row. local, cluster: execution in threads or by Dask. journal: results on
disk, so that an interrupted study can be resumed. table: the result table. fit: parameter
estimation from a recording.
"""
