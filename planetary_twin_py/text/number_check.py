"""Checks that what a caller gives as a quantity is a number."""

from __future__ import annotations

from .escaping import one_line

_LONGEST = 60  # characters of a value in a message


def check_number(name: str, value: object, unit: str = "") -> None:
    """Check that a value is a number: of Python, or of NumPy without dimensions.

    Args:
        name: name of the argument, for the message.
        value: any object.
        unit: SI unit of the quantity, for the message; empty for numbers without unit.

    Raises:
        ValueError: the value is no number, such as a text or an array.
    """
    # Not `isinstance(value, SupportsFloat)`, which inspects the protocol at every call.
    if not hasattr(value, "__float__") or getattr(value, "ndim", 0) > 0:
        shown = f" [{unit}]" if unit else ""
        raise ValueError(
            f"{name} = {one_line(repr(value), _LONGEST)}: must be a number{shown}"
        ) from None
