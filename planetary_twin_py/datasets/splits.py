"""Which part of a data set each specimen is in."""

from __future__ import annotations

import math

from ..scene import SceneError
from .draws import Place, chance
from .spec import DatasetSpec


def splits_of(spec: DatasetSpec) -> list[str]:
    """Part of each specimen.

    The numbers of specimens are the shares by largest remainder, and who is in which part is drawn.

    Args:
        spec: of the data set.

    Raises:
        SceneError: a part with a share has no specimen.
    """
    shares = {name: share for name, share in spec.splits.shares.items() if share}
    exact = {name: share * spec.specimens for name, share in shares.items()}
    counts = {name: math.floor(value + 1e-9) for name, value in exact.items()}
    missing = spec.specimens - sum(counts.values())
    for name in sorted(counts, key=lambda name: counts[name] - exact[name])[:missing]:
        counts[name] += 1
    for name, count in counts.items():
        if not count:
            raise SceneError(
                f"splits.{name} = {shares[name]:g}: gives none of {spec.specimens} specimens; "
                "must be 0 or enough for one"
            )
    parts = [name for name, count in counts.items() for _ in range(count)]
    order = chance(spec.seed, Place.SPLIT).permutation(spec.specimens)
    return [parts[place] for place in order]
