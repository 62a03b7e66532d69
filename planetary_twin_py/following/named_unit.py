"""Names the unit of a torque that is neither in N m nor in a thousandth or a thousand of it."""

from ..units import to_si

CLOSE = 0.9, 1.02  # range of a torque ratio over that without loss in which a unit is named
UNITS = "lbf in", "kgf cm", "lbf ft", "kgf m"


def named_unit(share: float) -> str:
    """Name the unit of one torque that explains a torque ratio; empty if none does.

    Args:
        share: ratio of the torques over that without loss.
    """
    low, high = CLOSE
    if low <= share <= high:
        return ""
    for unit in UNITS:
        factor = float(str(to_si(f"1 {unit}", "N m")))
        for name, explained in (
            ("output_torque", share * factor),
            ("input_torque", share / factor),
        ):
            if low <= explained <= high:
                return f"{name} is probably in {unit}: scale {name} by {factor:.6g}"
    return ""
