"""A gear set on bearings: what the planar and the spatial model are built of."""

from __future__ import annotations

from dataclasses import dataclass

from ..model.planar_rows import CENTRAL


@dataclass(frozen=True)
class Body:
    """A body with its bearing; that of a planet is on the carrier.

    Arc lengths are at the base radius r, of the carrier at the radius of the planet centres.
    """

    mass: float
    """[kg]"""
    rim_mass: float
    """J/r^2 with the polar inertia J [kg]."""
    bearing: float
    """Radial stiffness of the bearing [N/m]."""
    torsion: float = 0.0
    """Stiffness of a torsional support, moment/angle/r^2 [N/m]."""
    across: float | None = None
    """Radial stiffness across the radius of a planet [N/m]; None: `bearing`."""
    radius: float = 1.0
    """r, for the spatial model [m]."""
    tilt_mass: float = 0.0
    """I/r^2 with the diametral inertia I, for the spatial model [kg]."""
    axial: float = 0.0
    """Axial stiffness of the bearing, for the spatial model [N/m]."""
    tilting: float = 0.0
    """Tilting stiffness of the bearing, moment/angle/r^2, for the spatial model [N/m]."""

    @property
    def sideways(self) -> float:
        """Radial stiffness across the radius of a planet [N/m]."""
        return self.bearing if self.across is None else self.across


@dataclass(frozen=True)
class SupportedSet:
    """A planetary gearset on its bearings."""

    sun: Body
    ring: Body
    carrier: Body
    planet: Body
    planet_angles: tuple[float, ...]
    """Positions of the planets [rad]."""
    sun_planet: float
    """Stiffness of a sun-planet mesh along its transverse line of action [N/m]."""
    planet_ring: float
    """Stiffness of a planet-ring mesh along its transverse line of action [N/m]."""
    sun_angle: float
    """Working pressure angle of the sun-planet meshes in the transverse plane [rad]."""
    ring_angle: float
    """Working pressure angle of the planet-ring meshes in the transverse plane [rad]."""
    mesh_factors: tuple[float, ...] = ()
    """Factors on the stiffness of both meshes of each planet, 0 if open, (planets,); default: 1."""
    pin_factors: tuple[float, ...] = ()
    """Factors on the radial stiffness of each planet's bearing, (planets,); default: 1."""
    base_helix: float = 0.0
    """Of the spatial model: helix angle on the base circle, positive for a right-hand sun [rad]."""
    face_width: float = 0.0
    """Of the spatial model: width along which each mesh resists tilting [m]; 0: at one point."""

    @property
    def planets(self) -> tuple[str, ...]:
        """Names of the planets."""
        return tuple(f"planet_{i + 1}" for i in range(len(self.planet_angles)))

    @property
    def factors(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Factors of the planets on the stiffness of their meshes, and of their bearings."""
        ones = (1.0,) * len(self.planet_angles)
        return self.mesh_factors or ones, self.pin_factors or ones

    def body(self, name: str) -> Body:
        """A body by its name, e.g. "planet_2"."""
        found: Body = getattr(self, name if name in CENTRAL else "planet")
        return found
