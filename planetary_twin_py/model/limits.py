"""Limits of displacements in a gear set, above which its teeth do not mesh."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .layout import Layout


class Limit(NamedTuple):
    """Largest magnitude of a quantity."""

    quantity: str
    unit: str
    names: Sequence[str]
    """Of the bodies, machines or meshes."""
    largest: np.ndarray
    """In `unit`, (names,)."""
    reason: str
    """Of the limit, for the message."""

    def check(self, values: np.ndarray) -> None:
        """Check values.

        Args:
            values: in `unit`, (times, names).

        Raises:
            ArithmeticError: a value exceeds its limit, or is NaN.
        """
        if (np.abs(values) <= self.largest).all():  # False if one is NaN
            return
        peak = np.abs(values).max(axis=0)
        k = int(np.flatnonzero(~(peak <= self.largest))[0])
        if np.isnan(peak[k]):
            raise ArithmeticError(
                f"{self.quantity} of {self.names[k]} = nan {self.unit}: must be a number: the "
                "motion grows without bound; reduce the torques, or increase stiffness and damping"
            )
        raise ArithmeticError(
            f"{self.quantity} of {self.names[k]} = {peak[k]:.4g} {self.unit}: must be at most "
            f"{self.largest[k]:.4g} {self.unit}, {self.reason}"
        )


def displacement_limit(layout: Layout) -> Limit:
    """Limit of the displacements of axes in the plane.

    Args:
        layout: of a scene with supports.
    """
    names, module = layout.bearings, layout.scene.gearset.transverse.module
    return Limit(
        "displacement",
        "m",
        names,
        np.full(len(names), module),
        "a module, beyond which teeth may not mesh; reduce the torque, clearances or offsets "
        "(errors.*_offset), or increase the stiffness of the bearings (supports.*.bearing)",
    )
