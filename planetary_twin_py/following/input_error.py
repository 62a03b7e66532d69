"""Error of readings that contradict the scene."""


class InputError(ValueError):
    """Readings that contradict the scene; the message names channel, value and correction."""
