"""Members, planets and machines of a scene: how they turn together, and what loads them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

import numpy as np

from ..gearset.kinematics import mesh_cycles_per_turn, mesh_frequency, speeds_per_input
from ..gearset.phasing import mesh_phases
from ..scene import OperatingPoint, Scene
from ..scene.drive import Machine
from .planar_rows import CENTRAL, PlanarRows, planar_rows
from .planet_groups import PlanetGroups, Signature, directions_cancel, planet_groups, signatures

# Indices of the machines. The motor of input 0 is machine 0, the motor of input 1 is machine 2.
MOTOR, LOAD_MACHINE, SECOND_MOTOR = 0, 1, 2
MACHINE_NAMES = ("motor", "load", "second_motor")

Ratios = tuple[Fraction, ...]  # speed per speed of each input


@dataclass(frozen=True, eq=False)
class Layout:
    """What follows from a scene without elasticity; computed once, when it is first read."""

    scene: Scene

    @cached_property
    def machines(self) -> dict[str, Machine]:
        """Motors and load by name, in the order of their indices."""
        motor, *second = self.scene.drive.inputs
        return dict(zip(MACHINE_NAMES, (motor, self.scene.drive.output, *second), strict=False))

    @cached_property
    def ratios(self) -> dict[str, Ratios]:
        """Speeds of every kind of body and of the machines per speed of each input."""
        gearset = self.scene.gearset
        members = [machine.member for machine in self.scene.drive.inputs]
        axes = speeds_per_input(gearset.tooth_numbers, members, gearset.held)
        ratios = {kind: tuple(axis[kind] for axis in axes) for kind in axes[0]}
        return ratios | {name: ratios[machine.member] for name, machine in self.machines.items()}

    @cached_property
    def cycles(self) -> Ratios:
        """Mesh cycles per turn of each input, signed."""
        teeth, inputs = self.scene.gearset.tooth_numbers, range(len(self.ratios["sun"]))
        return tuple(
            mesh_cycles_per_turn(teeth, {kind: each[n] for kind, each in self.ratios.items()})
            for n in inputs
        )

    def speeds(self, first: float, second: float = 0.0) -> dict[str, float]:
        """Speeds of rigid gears.

        Args:
            first: speed of the first motor [rad/s].
            second: speed of the second motor, if there is one [rad/s].

        Returns:
            Speed of every kind of body and of the machines [rad/s].
        """
        return {
            kind: sum(float(r) * speed for r, speed in zip(ratios, (first, second), strict=False))
            for kind, ratios in self.ratios.items()
        }

    def speeds_at(self, point: OperatingPoint) -> dict[str, float]:
        """Speeds of rigid gears at an operating point, see `speeds`."""
        return self.speeds(point.input_speed, point.second_input_speed)

    @property
    def mesh_frequency(self) -> float:
        """Mesh frequency of rigid gears at the operating point of the scene [Hz]."""
        speeds = self.speeds_at(self.scene.operating_point)
        return mesh_frequency(self.scene.gearset.tooth_numbers, speeds["sun"], speeds["carrier"])

    @cached_property
    def radii(self) -> dict[str, float]:
        """r [m] of x = r theta for each kind of body: base radii, r_c cos(phi) for the carrier.

        With the working pressure angle phi of the sun meshes, so it is r_bs + r_bp for the carrier.
        """
        gears = self.scene.gearset.geometry
        return {
            "sun": gears.sun.base_radius,
            "planet": gears.planet.base_radius,
            "ring": gears.ring.base_radius,
            "carrier": gears.centre_distance * math.cos(gears.meshes[0].pressure_angle),
        }

    @cached_property
    def masses(self) -> dict[str, float]:
        """J/r^2 [kg] of each kind of body, with the r of `radii`."""
        gearset = self.scene.gearset
        mass = gearset.rim_masses
        slant = 1.0 / math.cos(gearset.transverse.pressure_angle) ** 2  # (pitch/base radius)^2
        # The mass of the planets turns with the carrier, unless they move on it.
        carried = mass.carrier
        if not self.scene.moving_axes:
            carried += gearset.planets * gearset.planet_mass
        turned = 1.0 / math.cos(gearset.geometry.meshes[0].pressure_angle) ** 2
        return {
            "sun": mass.sun * slant,
            "planet": mass.planet * slant,
            "ring": mass.ring * slant,
            "carrier": carried * turned,
        }

    @cached_property
    def planar_radii(self) -> dict[str, float]:
        """r [m] of each kind of body in `rows`: that of the planet centres for the carrier."""
        return self.radii | {"carrier": self.scene.gearset.geometry.centre_distance}

    @cached_property
    def polar_masses(self) -> dict[str, float]:
        """J/r^2 [kg] of each kind of body with `planar_radii`; the carrier without planets."""
        return self.masses | {"carrier": self.scene.gearset.rim_masses.carrier}

    @cached_property
    def tilting_masses(self) -> dict[str, float]:
        """I/r^2 [kg] of each kind of body with `planar_radii` and the diametral inertia I."""
        return {
            kind: getattr(self.scene.supports, kind).diametral(self.polar_masses[kind])
            for kind in (*CENTRAL, "planet")
        }

    @cached_property
    def torques(self) -> dict[str, int]:
        """Torques of sun, ring and carrier in proportion, without loss.

        They follow from the teeth: Ts : Tr : Tc = Zs : Zr : -(Zs + Zr).
        """
        teeth = self.scene.gearset.tooth_numbers
        return {"sun": teeth.sun, "ring": teeth.ring, "carrier": -(teeth.sun + teeth.ring)}

    @cached_property
    def machine_torques(self) -> np.ndarray:
        """Torque of each machine over that of the first motor without loss [-], (machines,)."""
        members = [self.torques[machine.member] for machine in self.machines.values()]
        return np.array(members) / members[MOTOR]

    def mesh_force(self, torque: float) -> float:
        """Mean force of each mesh without loss.

        Args:
            torque: of the first motor [N m].

        Returns:
            The force [N].
        """
        sun_torque = torque * self.torques["sun"] / self.torques[self.scene.drive.input.member]
        return sun_torque / (self.radii["sun"] * self.scene.gearset.planets)

    @cached_property
    def planets(self) -> tuple[str, ...]:
        """Names of the planets."""
        return tuple(f"planet_{i + 1}" for i in range(self.scene.gearset.planets))

    @cached_property
    def bearings(self) -> tuple[str, ...]:
        """Names of the bodies on bearings, in the order of the core."""
        return (*CENTRAL, *self.planets)

    @cached_property
    def phases(self) -> tuple[list[Fraction], list[Fraction]]:
        """Phases of sun and ring meshes [cycles], (planets,) each, see `mesh_phases`."""
        gearset = self.scene.gearset
        first, second = (mesh.coast_lead for mesh in gearset.geometry.meshes)
        return mesh_phases(gearset.tooth_numbers, gearset.planet_angles, (first, second))

    @cached_property
    def groups(self) -> PlanetGroups:
        """Groups of planets with the same motion, in the order of their first planets."""
        apart = self.scene.moving_axes and not self.axes_stand
        return planet_groups(self._signatures, apart)

    @cached_property
    def axes_stand(self) -> bool:
        """Whether sun, ring and carrier cannot be displaced, as the forces on them cancel."""
        return directions_cancel(self._signatures, self.scene.gearset.planet_angles)

    @cached_property
    def _signatures(self) -> list[Signature]:
        return signatures(self.scene, self.phases)

    @cached_property
    def leaders(self) -> tuple[str, ...]:
        """Names of the planets that are integrated, one of each group."""
        return tuple(self.planets[leader] for leader in self.groups.leaders)

    @cached_property
    def rows(self) -> PlanarRows:
        """Rows of all meshes and planet bearings over the coordinates in the plane."""
        angles = [mesh.pressure_angle for mesh in self.scene.gearset.geometry.meshes]
        return planar_rows(self.scene.gearset.planet_angles, *angles)
