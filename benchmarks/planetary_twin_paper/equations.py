"""Law, file, default form and printed form of each equation of the paper."""

from __future__ import annotations

from typing import NamedTuple


class Equation(NamedTuple):
    """One or several equations of the paper that belong together."""

    numbers: tuple[str, ...]
    law: str
    file: str
    """Relative to planetary_twin_py."""
    default: str
    """Form of the scene `paper`."""
    printed: str
    """Form of the paper."""
    choice: str = ""
    """Scene field that selects the printed form, as "field: value"."""

    @property
    def label(self) -> str:
        """The numbers in brackets."""
        return ", ".join(f"({number})" for number in self.numbers)


def _numbers(first: int, last: int) -> tuple[str, ...]:
    return tuple(str(n) for n in range(first, last + 1))


EQUATIONS = (
    Equation(
        ("1a",), "speeds of sun, ring and carrier", "gearset/kinematics.py",
        "Willis, as printed, any member held", "the same",
    ),
    Equation(
        ("1b",), "speed ratio of sun and ring", "gearset/kinematics.py",
        "-Zr/Zs with the carrier held", "not applicable: the sign contradicts (1a)",
    ),
    Equation(
        ("1c", "1d"), "speeds of ring and planet", "gearset/kinematics.py",
        "from (1a) and Zp (wp - wc) = -Zs (ws - wc)",
        "not applicable: valid for a held ring if omega_r is read as omega_c",
    ),
    Equation(
        ("1e",), "meshing frequency", "gearset/kinematics.py",
        "Zs abs(ws - wc): 500 Hz at 1000 rpm",
        "350 Hz, which is valid for a held ring; can be used in the damping only",
        "mesh.damping.law: printed_meshing_frequency",
    ),
    Equation(
        ("2", "3"), "dynamic transmission error", "model/train.py",
        "along the line of action, from base radii", "along the pitch arcs",
        "mesh.motion: pitch_arc",
    ),
    Equation(
        ("4", "5"), "force of a mesh on both wheels", "core/mesh/mesh_forces.hpp",
        "k (DTE - B/2) + c DTE', never tensile", "fa (k DTE + c DTE'): jumps by k B",
        "mesh.backlash: regulatory_factor",
    ),
    Equation(
        ("6",), "sum of boundary and viscous friction", "core/lubrication/tooth_contact.hpp",
        "f_b + f_v of every tooth pair", "the same",
    ),
    Equation(
        ("7", "8"), "boundary friction", "core/lubrication/boundary.hpp",
        "tau0 A_a + eps W_a, which is equal but has no division", "the same",
    ),
    Equation(
        ("9",), "mean asperity pressure W_a/A_a", "core/lubrication/boundary.hpp",
        "not needed: (7) to (9) combine to tau0 A_a + eps W_a",
        "not applicable: the divisor becomes zero, and as printed negative above lambda 1.90",
    ),
    Equation(
        ("10",), "area of the asperities in contact", "core/lubrication/asperities.hpp",
        "F_2 within 3e-4 of its integral", "polynomial of the appendix, negative above lambda 1.90",
        "lubrication.asperities: printed",
    ),
    Equation(
        ("11",), "load of the asperities", "core/lubrication/asperities.hpp",
        "F_5/2 within 3e-4 of its integral, modulus E*",
        "polynomial of the appendix, with E' of (13) and (15), which is twice E*",
        "lubrication.modulus: printed",
    ),
    Equation(
        ("12",), "viscous friction", "core/lubrication/traction.hpp",
        "Evans and Johnson with the temperature coefficient of viscosity, at least zero",
        "without it: logarithm of a quantity in K^-1/2",
        "lubrication.traction: printed",
    ),
    Equation(
        ("13",), "heating of the film", "core/lubrication/traction.hpp",
        "as printed, with the conductivity of an oil", "conductivity 2000 W/(m K)",
        "lubrication.oil_conductivity: 2000 W/(m K)",
    ),
    Equation(
        ("14",), "load of a flank", "core/mesh/mesh_forces.hpp",
        "mesh force, shared by the tooth pairs in contact", "the same, not shared",
    ),
    Equation(
        ("15",), "film thickness", "core/lubrication/film.hpp",
        "(15) in scene `paper`; Dowson-Higginson, Dowson-Toyoda",
        "applicable: Dowson-Higginson with 3.38 in place of 2.65",
        "lubrication.film: salagianni",
    ),
    Equation(
        ("16",), "power loss", "core/lubrication/tooth_friction.hpp",
        "f Vs of every tooth pair", "the same",
    ),
    Equation(
        ("17",), "friction torque", "core/lubrication/tooth_friction.hpp",
        "-f dVs/dw on every body, dissipates exactly f Vs",
        "P/w on both gears: twice the loss; 0/0 at rest, where it is faded out",
        "lubrication.friction_torque: printed",
    ),
    Equation(
        ("18", "19", "20"), "equations of motion", "core/model/equations.hpp",
        "absolute angles, any member held, friction opposes sliding",
        "the sign of T_FR accelerates every gear",
        "lubrication.friction_torque: printed",
    ),
    Equation(
        ("21", "22"), "DTE with the carrier held", "model/train.py",
        "sums of displacements on the base circles, including the carrier", "along the pitch arcs",
        "mesh.motion: pitch_arc",
    ),
    Equation(
        ("20, section 9", "21, section 9"), "six coordinates and masses of a body",
        "modal/spatial.py", "as printed", "the paper uses the numbers (20) to (22) twice",
    ),
    Equation(
        ("22, section 9", "23", "24"), "equations of the three pairs", "modal/spatial.py",
        "a row for every spring, multiplied by the displacement",
        "not applicable: stiffness times acceleration",
    ),
    Equation(
        ("25", "26"), "stiffness of a mesh", "modal/spatial.py",
        "outer product of the row of the mesh",
        "entry (1,5) has the wrong sign, which matters for helical gears only; (26) has the "
        "stiffness of the sun mesh; matrices for comparison: planetary_twin_paper",
    ),
    Equation(
        ("27", "28"), "stiffness of a planet's bearing", "modal/spatial.py",
        "a row for every spring",
        "the last row of (27) has k_zz in place of k_xx: a common motion of carrier and planet is "
        "resisted; matrices for comparison: planetary_twin_paper",
    ),
    Equation(
        ("29", "30", "31"), "torsional equations of the three pairs", "modal/torsional.py",
        "a spring on the DTE of every mesh",
        "j in place of j/r^2, carrier not coupled; available as model `printed`",
    ),
    Equation(
        ("32", "36"), "equations of the gearset, and eigenproblem", "modal/modes.py",
        "as printed", "(36) lacks \"= 0\"",
    ),
    Equation(
        ("33", "34"), "masses and coordinates", "model/bodies.py",
        "J/r^2 as in (37), u = r theta", "J/r^2 of Table 4, half of (37)",
        "gearset.equivalent_mass: {sun: 0.136, planet: 0.05, ring: 0.389, carrier: 0.75}",
    ),
    Equation(
        ("35", "37", "38"), "matrices of the gearset", "modal/printed.py",
        "from the scene, along the lines of action (`modal/torsional.py`)",
        "as printed, carrier not coupled: `planetary_twin_py.simulation.natural_modes(scene, "
        "\"printed\")`",
    ),
)  # fmt: skip
