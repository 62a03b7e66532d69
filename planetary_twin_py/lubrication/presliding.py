"""Static friction: flanks that hardly move against each other hold like springs before they slide.

The elasto-plastic bristle of Dupont, Hayward, Armstrong and Altpeter 2002, Single state
elastoplastic friction models, IEEE Transactions on Automatic Control 47, 787-792, eqs. (6), (7)
and (10). Friction is a share z of what steady sliding would give, and z follows the sliding V:

    delta dz/dt = V (1 - a(z, V) z/z_s(V)),

z_s the share in steady sliding, delta the presliding displacement. The bristle is elastic (a = 0)
below a part of z_s, so a load that swings below break-away moves nothing for good; above it the
contact yields until it slides (a = 1). While the flanks roll, z_s is the traction curve and the
same equation says how bristles that leave the contact are replaced. The friction is that share and
a part that damps, z + RELAXATION dz/dt, of the full friction.
"""

from __future__ import annotations

import math

from .._compile import law

ELASTIC = 0.7  # part of the steady share below which nothing slides
# Damping of the bristles over their stiffness [s], sigma_1/sigma_0 of the model: as in Canudas de
# Wit, Olsson, Astrom and Lischinsky 1995, it damps what swings on them about half critically.
RELAXATION = 2e-5


@law
def bristle_rate(
    share: float, sliding: float, steady: float, slope: float, displacement: float
) -> tuple[float, float, float, float]:
    """How the share of friction changes, and what an implicit method needs of it.

    Args:
        share: z [-].
        sliding: V [m/s].
        steady: z_s [-] at that speed, of its sign.
        slope: dz_s/dV [s/m].
        displacement: delta [m].

    Returns:
        dz/dt [1/s]; its decay -d(dz/dt)/dz [1/s] and its gain d(dz/dt)/dV [1/m], neither below
        zero; the part of the sliding that dissipates, a V z/z_s [m/s].
    """
    small = abs(steady) < 1e-9
    layer = 1.0 / max(slope, 1e-300) if small else sliding / steady
    bend = 0.0 if small else (1.0 - layer * slope) / steady  # of that layer with V
    yielding, growth = _yielding(abs(share), abs(steady))
    if share * sliding < 0.0:
        yielding = growth = 0.0
    slip = yielding * layer * share
    decay = layer * (yielding + growth * abs(share)) / displacement
    gain = max(1.0 - yielding * share * bend, 0.0) / displacement
    return (sliding - slip) / displacement, decay, gain, slip


@law
def _yielding(share: float, steady: float) -> tuple[float, float]:
    """a of the model, and da/dz, from the magnitudes of both shares."""
    elastic = ELASTIC * steady
    if share <= elastic:
        return 0.0, 0.0
    if share >= steady:
        return 1.0, 0.0
    phase = math.pi / (steady - elastic)
    angle = phase * (share - 0.5 * (steady + elastic))
    return 0.5 + 0.5 * math.sin(angle), 0.5 * phase * math.cos(angle)
