"""Recognises codes for missing samples, a stuck sensor and a clipped signal.

The latter two show by samples that are exactly equal.

Successive samples of a quantised signal are equal with a probability p that the signal itself
shows. A run of L equal samples among n is chance with a probability of about n p^(L - 1). A signal
that is slow for its quantisation stays at a level near each of its extreme values, 4.8 times as
long as at the next one in the case of a sine.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from .codes import far_codes

Array = NDArray[np.float64]

CHANCE = 1e-6  # probability of a run, below which it is no chance
LONGER = 8.0  # times the third longest run: a sensor that is stuck once or twice
FEWEST = 16  # equal samples that change a spectrum noticeably
BESIDE = 0.01  # of the range: samples below an extreme value, with which those at it are compared
PILED = 4.0  # samples at an extreme value over those beside it; 2.4 for a sine of few levels
CLIPPED = 3  # successive samples at an extreme value; a tone has two at most


def fault_remarks(time: Array, samples: Array) -> Iterator[str]:
    """A line for codes, a run of constant samples, and samples that pile up at an extreme value.

    Args:
        time: time stamps [s], (n,).
        samples: in any unit, (n,).
    """
    if len(samples) < FEWEST or np.ptp(samples) == 0.0:
        return
    codes, *_ = far_codes(samples[:, None], np.zeros(1), np.zeros(1))
    if len(rows := np.flatnonzero(codes)):
        first = rows[0]
        yield (
            f"{len(rows)} samples are codes for missing or saturated readings, the first is "
            f"{samples[first]:.6g} at {time[first]:.6g} s: lines are wrong by them; select another "
            "interval by --from and --to"
        )
        return
    begins, lengths = _runs(samples)
    longest = int(lengths.argmax())
    length, first = int(lengths[longest]), int(begins[longest])
    equal = len(samples) - len(lengths) - (length - 1)  # pairs outside of this run
    share = (equal + 1) / (len(samples) - length + 1)
    chance = len(samples) * share ** (length - 1)
    usual = int(np.sort(lengths)[-3:][0])
    if length >= FEWEST and length > LONGER * usual and chance < CHANCE:
        yield (
            f"{length} successive samples are exactly {samples[first]:.6g}, from {time[first]:.6g} "
            f"to {time[first + length - 1]:.6g} s: is the sensor stuck, or the signal below its "
            "resolution? Select another interval by --from and --to"
        )
        lengths[longest] = 0  # stuck, not clipped
    for name, value in (("lowest", samples.min()), ("highest", samples.max())):
        there = lengths[samples[begins] == value]
        if not (there >= CLIPPED).any():
            continue
        away = np.abs(samples - value)
        near = away <= max(BESIDE * float(away.max()), float(away[away > 0.0].min()))
        beside = np.count_nonzero(near & (away > 0.0))
        if there.sum() > PILED * beside:
            yield (
                f"{np.mean(away == 0.0):.2g} of the samples are exactly at the {name} value, "
                f"{value:.6g}: if the signal is clipped there, its lines are too low and its "
                "harmonics wrong; increase the range of the sensor"
            )


def _runs(samples: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First samples and lengths of the runs of equal samples."""
    begins = np.flatnonzero(np.diff(samples, prepend=np.nan) != 0.0)
    return begins, np.diff(begins, append=len(samples))
