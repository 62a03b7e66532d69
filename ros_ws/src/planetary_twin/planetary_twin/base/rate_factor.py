"""The rate factor: simulated or recorded seconds per second."""

SLOWEST, FASTEST = 0.01, 100.0
"""Range of the rate factor: simulated seconds per second."""
UNLIMITED = 0.0
"""Rate factor without a limit: as fast as possible."""


def check_rate_factor(rate_factor: float) -> None:
    """Raise `ValueError` if `rate_factor` is out of range."""
    if rate_factor != UNLIMITED and not SLOWEST <= rate_factor <= FASTEST:
        raise ValueError(
            f"rate_factor = {rate_factor:g}: must be within {SLOWEST:g} and {FASTEST:g}, "
            f"or {UNLIMITED:g} for as fast as possible"
        )
