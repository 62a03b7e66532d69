"""Tooth loss factor of a gear pair (Ohlendorf 1958): H_v of P_loss = P mu H_v.

The pairs in contact share the load equally; the friction coefficient mu is constant.
"""

from __future__ import annotations

import math
from itertools import pairwise

from ..gearset.geometry import PathOfContact


def slip_per_position(first: float, second: float, internal: bool) -> float:
    """Sliding speed of a pair a base pitch from the pitch point, over the speed of the flanks [-].

    The speed of the flanks is that along the line of action: 2 pi (1/z1 +- 1/z2).

    Args:
        first: number of teeth z1.
        second: number of teeth z2.
        internal: whether the second gear is a ring, with the minus sign.
    """
    return 2.0 * math.pi * (1.0 / first + (-1.0 if internal else 1.0) / second)


def tooth_loss_factor(
    path: PathOfContact,
    first: float,
    second: float,
    internal: bool = False,
    base_helix: float = 0.0,
) -> float:
    """H_v [-], the mean of sliding speed times share of the load over the path of contact.

    The integral is exact for every path. With one pair in contact at the pitch point it is
    pi (1/z1 +- 1/z2) (1 - eps + eps1^2 + eps2^2), the closed form.

    Args:
        path: path of contact.
        first: number of teeth of the first gear.
        second: number of teeth of the second gear.
        internal: whether the second gear is a ring.
        base_helix: helix angle beta_b on the base circle [rad]; it divides the result by
            cos(beta_b) (Niemann and Winter 2003).
    """
    slip = slip_per_position(first, second, internal)
    return slip * _mean_distance(path) / math.cos(base_helix)


def _mean_distance(path: PathOfContact) -> float:
    """Mean over a mesh cycle of the distance of the load from the pitch point [base pitches].

    Between the corners, the number of pairs and the side of the pitch point are constant, so the
    mean distance is that of the middle.
    """
    begin, end = -path.approach, path.recess
    steps = range(-math.ceil(path.contact_ratio), math.ceil(path.contact_ratio) + 1)
    corners = {0.0} | {begin + n for n in steps} | {end + n for n in steps}
    within = sorted(corner for corner in corners if begin <= corner <= end)
    total = 0.0
    for low, high in pairwise(within):
        middle = 0.5 * (low + high)
        pairs = sum(begin <= middle + n <= end for n in steps)
        total += abs(middle) * (high - low) / pairs
    return total
