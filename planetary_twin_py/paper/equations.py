"""Where each equation of the paper is: its law, file, default and printed form."""

from __future__ import annotations

from typing import NamedTuple


class Equation(NamedTuple):
    """One or several equations of the paper that belong together."""

    numbers: tuple[str, ...]
    law: str
    file: str  # below planetary_twin_py
    default: str
    printed: str
    choice: str = ""  # the scene field that turns the printed form on, as "field: value"

    @property
    def label(self) -> str:
        """The numbers in brackets."""
        return ", ".join(f"({number})" for number in self.numbers)


def _numbers(first: int, last: int) -> tuple[str, ...]:
    return tuple(str(n) for n in range(first, last + 1))


EQUATIONS = (
    Equation(
        ("1a",), "speeds of sun, ring and carrier", "gearset/kinematics.py",
        "Willis, as printed, for any held member", "the same",
    ),
    Equation(
        ("1b",), "speed ratio of sun and ring", "gearset/kinematics.py",
        "-Zr/Zs with the carrier held", "cannot run: the sign contradicts (1a)",
    ),
    Equation(
        ("1c", "1d"), "speeds of ring and planet", "gearset/kinematics.py",
        "from (1a) and Zp (wp - wc) = -Zs (ws - wc)",
        "cannot run: holds for a held ring and omega_r read as omega_c",
    ),
    Equation(
        ("1e",), "meshing frequency", "gearset/kinematics.py",
        "Zs abs(ws - wc): 500 Hz at 1000 rpm",
        "350 Hz, that of a held ring; runs in the damping only, as teeth mesh when they meet",
        "mesh.damping.law: printed_meshing_frequency",
    ),
    Equation(
        ("2", "3"), "dynamic transmission error", "dynamics/train.py",
        "along the line of action, from base radii", "along the pitch arcs",
        "mesh.motion: pitch_arc",
    ),
    Equation(
        ("4", "5"), "force of a mesh on both wheels", "dynamics/mesh_force.py",
        "k (DTE - B/2) + c DTE', never pulling", "fa (k DTE + c DTE'): jumps by k B",
        "mesh.backlash: regulatory_factor",
    ),
    Equation(
        ("6",), "friction is boundary and viscous", "dynamics/tooth_contact.py",
        "sum of the forces f_b and f_v of every tooth pair", "the same",
    ),
    Equation(
        ("7", "8"), "boundary friction", "lubrication/boundary.py",
        "tau0 A_a + eps W_a, the same without a division", "the same",
    ),
    Equation(
        ("9",), "mean asperity pressure W_a/A_a", "lubrication/boundary.py",
        "not needed: (7) to (9) together are tau0 A_a + eps W_a",
        "cannot run: divides by an area that vanishes, and is negative as printed from lambda 1.90",
    ),
    Equation(
        ("10",), "area of the asperities in contact", "lubrication/asperities.py",
        "F_2 within 3e-4 of its integral", "polynomial of the appendix, negative from lambda 1.90",
        "lubrication.asperities: printed",
    ),
    Equation(
        ("11",), "load of the asperities", "lubrication/asperities.py",
        "F_5/2 within 3e-4 of its integral, modulus E*",
        "polynomial of the appendix, and the same E' as in (13) and (15), twice E*",
        "lubrication.modulus: printed",
    ),
    Equation(
        ("12",), "viscous friction", "lubrication/traction.py",
        "Evans and Johnson with the temperature coefficient of viscosity, at least zero",
        "without it: a logarithm of something in K^-1/2",
        "lubrication.traction: printed",
    ),
    Equation(
        ("13",), "heating of the film", "lubrication/traction.py",
        "as printed, with the conductivity of an oil", "conductivity 2000 W/(m K)",
        "lubrication.oil_conductivity: 2000 W/(m K)",
    ),
    Equation(
        ("14",), "load of a flank", "dynamics/mesh_force.py",
        "force of the mesh, shared among the tooth pairs in contact", "the same, unshared",
    ),
    Equation(
        ("15",), "film thickness", "lubrication/film.py",
        "(15) in scene `paper`; Dowson-Higginson, Dowson-Toyoda",
        "runs as it stands: Dowson-Higginson with 3.38 for 2.65",
        "lubrication.film: salagianni",
    ),
    Equation(
        ("16",), "power loss", "dynamics/tooth_friction.py",
        "f Vs of every tooth pair", "the same",
    ),
    Equation(
        ("17",), "friction torque", "dynamics/tooth_friction.py",
        "-f dVs/dw on every body, takes exactly f Vs",
        "P/w on both gears: twice the loss; 0/0 at rest, where it fades out here",
        "lubrication.friction_torque: printed",
    ),
    Equation(
        ("18", "19", "20"), "equations of motion", "dynamics/equations.py",
        "absolute angles, any held member, friction against the sliding",
        "the sign of T_FR drives every gear the way it turns",
        "lubrication.friction_torque: printed",
    ),
    Equation(
        ("21", "22"), "DTE with the carrier held", "dynamics/train.py",
        "sums of base-circle motions, carrier included", "along the pitch arcs",
        "mesh.motion: pitch_arc",
    ),
    Equation(
        ("20, section 9", "21, section 9"), "six coordinates and masses of a body",
        "modal/spatial.py", "as printed", "the numbers (20) to (22) are used twice",
    ),
    Equation(
        ("22, section 9", "23", "24"), "equations of the three pairs", "modal/spatial.py",
        "a row for every spring, multiplied by the displacement",
        "cannot run: stiffness times acceleration",
    ),
    Equation(
        ("25", "26"), "stiffness of a mesh", "modal/printed_spatial.py",
        "outer product of the row of the mesh (`modal/spatial.py`)",
        "entry (1,5) has the wrong sign, which shows with a helix only; (26) names the sun's "
        "stiffness; kept as matrices for comparison",
    ),
    Equation(
        ("27", "28"), "stiffness of a planet's bearing", "modal/printed_spatial.py",
        "a row for every spring (`modal/spatial.py`)",
        "the last row of (27) has k_zz for k_xx: moving carrier and planet together would be "
        "resisted; kept as matrices for comparison",
    ),
    Equation(
        ("29", "30", "31"), "torsional equations of the three pairs", "modal/torsional.py",
        "a spring on the DTE of every mesh", "j for j/r^2, carrier apart; runs as model `printed`",
    ),
    Equation(
        ("32", "36"), "equations of the set and eigenproblem", "modal/modes.py",
        "as printed", "(36) lacks \"= 0\"",
    ),
    Equation(
        ("33", "34"), "masses and coordinates", "dynamics/bodies.py",
        "J/r^2 as in (37), u = r theta", "J/r^2 of Table 4, half of (37)",
        "gearset.equivalent_mass: {sun: 0.136, planet: 0.05, ring: 0.389, carrier: 0.75}",
    ),
    Equation(
        ("35", "37", "38"), "matrices of the set", "modal/printed.py",
        "from the scene, along the lines of action (`modal/torsional.py`)",
        "literally, no coupling of the carrier: `planetary_twin_py.natural_modes(scene, "
        "\"printed\")`",
    ),
)  # fmt: skip
