"""The mesh along the line of action: stiffness, damping, backlash and transmission error."""

from __future__ import annotations

import math
from typing import Literal, Self

from pydantic import Field, model_validator

from ..tooth.tooth import HUB, RIM
from .quantity import Section, quantity
from .worn import WornFlanks

LARGEST_ERROR = 1e-3  # [m], beyond plausible form errors of a tooth


class MeshDamping(Section):
    """Damping c = tau k of a mesh, proportional to its present stiffness k.

    "meshing_frequency": tau = loss_factor/f_m, f_m not below `lowest_frequency` (Salagianni et
    al. 2017, section 3, whose printed law is unbounded at standstill).
    "printed_meshing_frequency": the same with f_m as their eq. (1e) prints it, which is that of a
    held ring. "natural_frequency": tau = loss_factor/f_n with the natural frequency of the mesh on
    its own two gears. "viscous": tau from the damping ratio of that natural mode. The last two
    do not depend on the speed.
    """

    law: Literal[
        "meshing_frequency", "printed_meshing_frequency", "natural_frequency", "viscous"
    ] = Field("viscous", description="law of the damping time tau = c/k")
    damping_ratio: float = quantity(
        "", "damping ratio of one mesh, for law: viscous", 0.05, ge=0.0, le=2.0
    )
    loss_factor: float = quantity(
        "", "tau times the frequency of the law, for the other laws", 0.009, ge=0.0, le=1.0
    )
    lowest_frequency: float = quantity(
        "Hz", "lower limit of the mesh frequency in the law", 5.0, gt=0.0, le=1e4
    )

    @property
    def follows_speed(self) -> bool:
        """Whether the damping depends on the mesh frequency."""
        return self.law in ("meshing_frequency", "printed_meshing_frequency")


class TransmissionError(Section):
    """Static transmission error of a mesh: harmonics of the mesh frequency.

    e = sum of a_n sin(2 pi n x + p_n) over n = 1, 2, ..., with x the mesh cycles since a pair was
    at the pitch point. The mesh deflection is |d - e| - B/2, with d the DTE: positive e is missing
    material on the drive flanks, and excess material on the coast flanks; the backlash does not
    change.
    """

    amplitudes: tuple[float, ...] = quantity(
        "m",
        "amplitudes of harmonics 1, 2, ... of e, each within "
        f"{-LARGEST_ERROR:g} and {LARGEST_ERROR:g}; positive e: missing material",
        (),
        max_length=4,
    )
    phases: tuple[float, ...] = quantity(
        "rad", "phases of these harmonics; none: all zero", (), max_length=4
    )

    @model_validator(mode="after")
    def _a_phase_each(self) -> Self:
        for amplitude in self.amplitudes:
            if abs(amplitude) > LARGEST_ERROR:
                raise ValueError(
                    f"amplitudes = {list(self.amplitudes)}: must be within "
                    f"{-LARGEST_ERROR:g} and {LARGEST_ERROR:g}"
                )
        if self.phases and len(self.phases) != len(self.amplitudes):
            raise ValueError(
                f"phases = {list(self.phases)}: must be as many as amplitudes, or none"
            )
        return self


class Runout(Section):
    """Eccentricity of the gears, which repeats with every turn.

    Each adds the eccentricity times the sine of the gear's angle to the error e, with the sign of
    `sun_planet_error` and `planet_ring_error`. The phase of the sine is shifted by the pressure
    angle phi, with opposite signs on drive and coast flanks: the backlash changes by up to
    2 sin(phi) times the eccentricity. A scene is refused if both flanks of a tooth would touch
    under half of the static load.
    """

    sun: float = quantity("m", "eccentricity of the sun", 0.0, ge=0.0, le=1e-2)
    planet: float = quantity("m", "eccentricity of every planet", 0.0, ge=0.0, le=1e-2)
    ring: float = quantity("m", "eccentricity of the ring", 0.0, ge=0.0, le=1e-2)


class TipRelief(Section):
    """Material that is missing near the tips of a gear, on both flanks."""

    amount: float = quantity("m", "missing material at the tip", ge=0.0, le=LARGEST_ERROR)
    length: float = quantity("m", "length from the tip, on the line of action", gt=0.0, le=1.0)
    shape: Literal["linear", "parabolic"] = Field(
        "linear", description="growth of the missing material towards the tip"
    )


class TipReliefs(Section):
    """Tip relief of the gears; that of the planets acts in both meshes.

    Stiffness and load sharing of a mesh are those of the load of the operating point.
    """

    sun: TipRelief | None = Field(None, description="relief of the sun")
    planet: TipRelief | None = Field(None, description="relief of every planet")
    ring: TipRelief | None = Field(None, description="relief of the ring")


class ToothCompliance(Section):
    """Computation of the stiffness of a tooth pair from its geometry.

    Contact "weber_banaschek": contact deformation at the load of the operating point.
    "yang_sun": the constant compliance of much of the literature, which neglects most of it.
    """

    contact: Literal["weber_banaschek", "yang_sun"] = Field(
        "weber_banaschek", description="law of the contact compliance"
    )
    hub: float = quantity(
        "", "radius at which sun and planets are clamped/root radius", HUB, ge=0.1, le=0.95
    )
    rim: float = quantity(
        "", "radius at which the ring is clamped/root radius", RIM, ge=1.02, le=5.0
    )


class Mesh(Section):
    """Stiffness, damping, backlash and errors along the line of action.

    Stiffness "given": by the fields below; constant with `double_pair_ratio` 1, a step function
    with `ramp` 0. "involute": computed from the tooth geometry for every position of a pair; two
    pairs share one gear body. Pairs enter and leave contact over `ramp` in both.

    Backlash "dead_zone": F = k (DTE - B/2), with B the backlash. "regulatory_factor": F = k DTE
    for |DTE| > B, else 0; the discontinuous printed form of Salagianni et al. 2017, (2)-(5).

    Motion "line_of_action": stiffness and backlash refer to the DTE along the line of action.
    "pitch_arc": they refer to the DTE along the pitch circles, as in (2) and (3) of Salagianni et
    al., so the mesh is stiffer by 1/cos(phi). Results are along the line of action in both cases.
    """

    stiffness: Literal["given", "involute"] = Field(
        "given", description="given: by fields; involute: computed from the tooth geometry"
    )
    sun_planet_stiffness: float | None = quantity(
        "N/m", "stiffness of a single tooth pair; for stiffness: given", None, ge=1e3, le=1e13
    )
    planet_ring_stiffness: float | None = quantity(
        "N/m", "stiffness of a single tooth pair; for stiffness: given", None, ge=1e3, le=1e13
    )
    double_pair_ratio: float = quantity(
        "", "stiffness of two pairs/stiffness of one pair", 1.75, ge=1.0, le=2.0
    )
    ramp: float = quantity(
        "",
        "base pitches over which a pair takes up its load, with stiffness given or involute; a "
        "longer ramp lowers the rms of the DTE; 0: a step",
        0.03,
        ge=0.0,
        le=0.2,
    )
    entry: Literal["ramp", "loaded"] = Field(
        "ramp",
        description="how a pair comes into contact: over `ramp`; loaded: where the load of the "
        "operating point closes the separation of its teeth, before and after the nominal path",
    )
    backlash: Literal["dead_zone", "regulatory_factor"] = Field(
        "dead_zone", description="backlash law"
    )
    motion: Literal["line_of_action", "pitch_arc"] = Field(
        "line_of_action", description="direction to which stiffness and backlash refer"
    )
    tooth: ToothCompliance = Field(
        ToothCompliance(), description="tooth compliance, for stiffness: involute"
    )
    tip_relief: TipReliefs = Field(TipReliefs(), description="relief of the tips")
    worn: WornFlanks = Field(WornFlanks(), description="worn flanks of all teeth")
    damping: MeshDamping = Field(MeshDamping(), description="damping of a mesh")
    sun_planet_error: TransmissionError = Field(
        TransmissionError(), description="static transmission error of every sun-planet mesh"
    )
    planet_ring_error: TransmissionError = Field(
        TransmissionError(), description="static transmission error of every planet-ring mesh"
    )
    runout: Runout = Field(Runout(), description="eccentricities of the gears")

    @model_validator(mode="after")
    def _require_stiffness(self) -> Self:
        if self.stiffness == "given":
            for name in ("sun_planet_stiffness", "planet_ring_stiffness"):
                if getattr(self, name) is None:
                    raise ValueError(f"{name}: missing; give it, or set stiffness: involute")
            if self.double_pair_ratio == 1.0 and (loaded := self._feels_load):
                raise ValueError(
                    f"{loaded}: requires stiffness: involute, or a double_pair_ratio above 1"
                )
        return self

    @property
    def _feels_load(self) -> str:
        """What makes pairs share a load by their gaps, "" if nothing does."""
        if self.tip_relief != TipReliefs():
            return "tip_relief"
        if self.worn != WornFlanks():
            return "worn"
        return "entry = 'loaded'" if self.entry == "loaded" else ""

    def flanks(self, backlash: float, pressure_angle: float) -> tuple[float, float]:
        """Transmission errors at which flanks meet, and from which the force grows [m].

        Args:
            backlash: total backlash, along what `motion` says [m].
            pressure_angle: of the gearset [rad].
        """
        along = math.cos(pressure_angle) if self.motion == "pitch_arc" else 1.0
        if self.backlash == "regulatory_factor":
            return backlash * along, 0.0
        half = 0.5 * backlash * along
        return half, half
