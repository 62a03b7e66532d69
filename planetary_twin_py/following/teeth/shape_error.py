"""How uncertain the size of a change is, from how far its shape is from that of the signature.

The share of the load that a planet carries, and so the effect of a cracked tooth, depends on errors
of the gears that the scene does not have, as runouts. They change the size of the effect and its
shape by similar amounts. So what the shape lacks tells how far the size may be wrong.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LEAST = 0.06  # relative standard deviation of a size whose signature fits: laws of the model
PER_SHAPE = 0.4  # the same per tangent of the angle between deviation and signature: with runouts
# of 5 um of sun and ring, sizes are 0.6 to 1.35 times the true ones, at tangents of 0.4 to 1.5


def shape_error(signature: Array, after: Array, before: Array, baseline: int) -> float:
    """Relative standard deviation of the size of a change; NaN if there is only one block.

    The signature is (teeth, bins); residuals `after`, without other changed teeth, and `before` the
    change are (blocks, cycles, bins), all in m.
    """
    turns = after.shape[1] // len(signature)
    folded = [
        blocks.reshape(len(blocks), turns, *signature.shape).mean(axis=1)
        for blocks in (after, before)
    ]
    mean = folded[0].mean(axis=0)
    scatter = [float(np.sum((part - part.mean(axis=0)) ** 2)) for part in folded if len(part)]
    freedom = sum(len(part) - 1 for part in folded if len(part))
    if not freedom:
        return math.nan
    energy = float(np.sum(signature**2))
    amount = float(np.sum(mean * signature)) / energy
    noise = sum(scatter) / freedom * (1.0 / len(after) + 1.0 / baseline)
    noise_sd = noise * math.sqrt(2.0 / signature.size * (1.0 + 1.0 / freedom))  # chi-square
    rest = float(np.sum((mean - amount * signature) ** 2))
    misfit = max(rest - noise, 0.0) + noise_sd
    return math.hypot(LEAST, PER_SHAPE * math.sqrt(misfit / energy) / abs(amount))
