"""Estimates of a single run against the truth."""


def agrees(low: float, truth: float, high: float) -> bool:
    """Whether a truth lies within twice a 95 % interval.

    Stamps of a live run begin at the time of day, and with them the bins of a follower, so every
    run is another draw: one of twenty intervals may miss, one of ten thousand by as much as this.
    How many of many contain the truth is counted by `benchmarks/interval_coverage.py`.
    """
    return abs(truth - 0.5 * (low + high)) < high - low
