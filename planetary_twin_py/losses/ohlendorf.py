"""Tooth loss factor of a gear pair (Ohlendorf 1958): H_v of P_loss = P mu H_v.

The pairs in contact share the load equally; the friction coefficient mu is constant.
"""

from __future__ import annotations

import math

from ..gearset.geometry import PathOfContact


def tooth_loss_factor(
    path: PathOfContact, first: int, second: int, internal: bool = False, base_helix: float = 0.0
) -> float:
    """H_v [-] of gears with `first` and `second` teeth and the given path of contact.

    pi (u +- 1)/(z1 u cos(beta_b)) (1 - eps + eps1^2 + eps2^2), u = z2/z1, minus for an internal
    gear, with the helix angle `base_helix` [rad] on the base circle (Niemann and Winter 2003).
    """
    sense = -1.0 if internal else 1.0
    shares = 1.0 - path.contact_ratio + path.approach**2 + path.recess**2
    return math.pi * (1.0 / first + sense / second) * shares / math.cos(base_helix)
