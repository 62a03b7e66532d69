"""Time-synchronous average: what repeats with every turn of a gear.

The average over M turns keeps whole orders of the gear and lowers a tone of order f by the comb
|sin(pi M f) / (M sin(pi f))|, noise to 1/M of its variance (Braun 1975, Acustica 32, 69-77;
McFadden 1987, Mech. Syst. Signal Process. 1, 83-95).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..shaft.orders import SAMPLES_PER_TURN, resample_by_angle

Array = NDArray[np.float64]
FEWEST_TURNS = 2


class SynchronousAverage(NamedTuple):
    """A signal over one turn of a gear, and the turns of which it is the average."""

    angle: Array
    """Angle of the gear since the first sample, of one turn [rad], (points,)."""
    average: Array
    """Mean over the turns, in the unit of the signal, (points,)."""
    turns: Array
    """Each turn in the order of time, in the unit of the signal, (turns, points)."""

    @property
    def noise(self) -> float:
        """Rms of what does not repeat and is left in the average, in the unit of the signal.

        It is the scatter of the turns over the root of their number, for turns that are
        independent.
        """
        return math.sqrt(float(self.turns.var(axis=0, ddof=1).mean()) / len(self.turns))


def time_synchronous_average(
    samples: ArrayLike,
    angle: ArrayLike,
    samples_per_turn: int = SAMPLES_PER_TURN,
    turns_per_revolution: float = 1.0,
) -> SynchronousAverage:
    """Average a signal over the turns of a gear (Braun 1975; McFadden 1987).

    Errors of a mating gear vanish if the turns are whole meshing periods of the pair: a gear with
    Z1 teeth and its mate with Z2 repeat after Z2/gcd(Z1, Z2) turns of the first. In a planetary set
    turns are those relative to the carrier.

    Args:
        samples: the signal at equal steps of time, in any unit, (n,), n at least 8.
        angle: of a shaft at the samples, continuous over turns [rad], (n,).
        samples_per_turn: points of the average, see `resample_by_angle`. A multiple of the tooth
            number has points at the same places of every tooth.
        turns_per_revolution: turns of the gear per turn of the shaft, such as Zs/Zp for a planet
            and the angle of the sun, both relative to the carrier.

    Returns:
        Angle [rad] and average (points,), and every turn (turns, points). The part of a turn at the
        end is left out.

    Raises:
        ValueError: see `resample_by_angle`; there are several channels, the ratio is not positive,
            or the record has fewer than two turns of the gear.
    """
    if np.ndim(samples) != 1:
        raise ValueError(f"samples: shape {np.shape(samples)}: must be one channel, (n,)")
    if not 0.0 < turns_per_revolution < math.inf:
        raise ValueError(f"turns_per_revolution = {turns_per_revolution:g}: must be positive")
    of_gear = turns_per_revolution * np.asarray(angle, dtype=np.float64)
    resampled = resample_by_angle(samples, of_gear, samples_per_turn)
    count = len(resampled.samples) // samples_per_turn
    if count < FEWEST_TURNS:
        raise ValueError(
            f"samples: {len(resampled.samples) / samples_per_turn:.3g} turns of the gear: must be "
            f"at least {FEWEST_TURNS}"
        )
    turns = resampled.samples[: count * samples_per_turn].reshape(count, samples_per_turn)
    return SynchronousAverage(resampled.angle[:samples_per_turn], turns.mean(axis=0), turns)
