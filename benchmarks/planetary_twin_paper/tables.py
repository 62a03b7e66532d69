"""Tables 2 to 4: geometry, oil and surfaces, masses."""

from __future__ import annotations

import math

from planetary_twin_py.gearset.geometry import pitch_radius
from planetary_twin_py.scene import Scene

from .entry import Claim, Entry
from .evidence import Evidence
from .judge import agrees
from .pitch_point import RING, SUN, at_pitch_point

MASSES = {"sun": 0.272, "ring": 0.779, "carrier": 1.5, "planet": 0.1}  # [kg] Table 4
HALVED = {"sun": 0.136, "ring": 0.389, "carrier": 0.75, "planet": 0.05}  # [kg] row j/r^2
DIAMETERS = {"sun": 0.024, "ring": 0.056, "carrier": 0.040, "planet": 0.016}  # [m]
STEEL = 7800.0  # [kg/m^3]


def _row(values: dict[str, float], unit: str = "", scale: float = 1.0) -> str:
    text = "/".join(f"{scale * values[name]:.4g}" for name in MASSES)
    return f"{text} {unit}".rstrip()


def geometry(evidence: Evidence) -> Entry:
    """Table 2."""
    gearset = evidence.scene.gearset
    teeth, angle = gearset.tooth_numbers, math.degrees(gearset.transverse.pressure_angle)
    radii = [1e3 * pitch_radius(z, gearset.transverse.module) for z in teeth]
    ratios = [mesh.path.contact_ratio for mesh in gearset.geometry.meshes]
    stated = (30, 20, 70, 0.8e-3, 21.34)
    ours = (*teeth, gearset.transverse.module, angle)
    radii_text = "/".join(f"{r:g}" for r in radii)
    base_text = "/".join(f"{r * math.cos(gearset.transverse.pressure_angle):.4f}" for r in radii)
    return Entry(
        number="Table 2",
        title="geometry",
        claims=(
            Claim(
                says="30/20/70 teeth (sun/planet/ring), module 0.8 mm, pressure angle 21.34 deg",
                ours=f"{teeth.sun}/{teeth.planet}/{teeth.ring}, "
                f"{1e3 * gearset.transverse.module:g} mm, {angle:g} deg",
                holds=agrees(ours, stated),
                kind="number",
            ),
        ),
        remarks=f"The pitch radii are {radii_text} mm and the base radii {base_text} mm. With an "
        f"addendum of {gearset.addendum:g} module, which is not in the paper, the contact ratios "
        f"are {ratios[SUN]:.4f} (sun-planet) and {ratios[RING]:.4f} (planet-ring). The face width "
        f"of {1e3 * gearset.face_width:g} mm is not in the paper, either.",
        figures={"contact_ratios": ratios},
    )


def oil(evidence: Evidence) -> Entry:
    """Table 3."""
    ours, printed = evidence.scene.lubrication, evidence.printed.lubrication
    stated = {
        "roughness_parameter": 0.055,
        "asperity_slope": 0.001,
        "pressure_viscosity": 2.1e-8,
        "viscosity": 0.08,
        "shear_stress": 2.3e6,
    }
    found = {name: getattr(ours, name) for name in stated}
    friction = [
        at_pitch_point(evidence.scene.replace(**changes), SUN).viscous
        for changes in ({}, {"lubrication.oil_conductivity": 2000.0})
    ]
    return Entry(
        number="Table 3",
        title="lubricant and roughness",
        claims=(
            Claim(
                says="xi beta sigma 0.055, sigma/beta 0.001, alpha 2.1e-8 1/Pa, eta0 0.08 Pa s, "
                "tau0 2.3 MPa",
                ours=", ".join(f"{value:g}" for value in found.values()),
                printed=", ".join(f"{getattr(printed, name):g}" for name in stated),
                holds=agrees(list(found.values()), list(stated.values())),
                printed_holds=all(agrees(getattr(printed, n), v) for n, v in stated.items()),
                kind="number",
            ),
            Claim(
                says="conductivity 2000 W/(m K)",
                ours=f"{ours.oil_conductivity:g} W/(m K)",
                printed=f"{printed.oil_conductivity:g} W/(m K)",
                holds=agrees(ours.oil_conductivity, 2000.0),
                printed_holds=agrees(printed.oil_conductivity, 2000.0),
                kind="number",
                why="neither oil nor steel (46 W/(m K)) has a conductivity of 2000 W/(m K); 2000 "
                "J/(kg K) would be the heat capacity of an oil",
            ),
        ),
        remarks="The conductivity has little effect: with 2000 in place of "
        f"{ours.oil_conductivity:g} W/(m K), the viscous friction of the sun-planet mesh changes "
        f"from {friction[0]:.1f} to {friction[1]:.1f} N, because the conductivity cancels when the "
        "film heats up. The properties of steel, eps of (8), the temperature coefficient of "
        "viscosity and sigma are not in the paper; `scene/packaged/paper.yaml` lists the values "
        "used.",
        figures={"viscous_friction_with_0.137_and_2000": friction},
    )


def masses(evidence: Evidence) -> Entry:
    """Table 4."""
    gearset, mesh = evidence.scene.gearset, evidence.scene.mesh
    ours, printed = (_masses(scene) for scene in (evidence.scene, evidence.printed))
    cosine = math.cos(gearset.transverse.pressure_angle)
    teeth = gearset.tooth_numbers
    pitch = {
        name: 2.0 * pitch_radius(z, gearset.transverse.module)
        for name, z in teeth._asdict().items()
    }
    pitch["carrier"] = 2.0 * pitch_radius(teeth.sun + teeth.planet, gearset.transverse.module)
    base = {name: cosine * diameter for name, diameter in pitch.items()}
    stiffness = (mesh.sun_planet_stiffness or 0.0, mesh.planet_ring_stiffness or 0.0)
    slim = _least_ring_inertia(gearset.transverse.module * teeth.ring / 2, gearset.face_width)
    return Entry(
        number="Table 4",
        title="masses, inertias, stiffness",
        claims=(
            Claim(
                says=f"masses {_row(MASSES)} kg (sun/ring/carrier/planet)",
                ours=f"J/r^2 = {_row(ours)} kg",
                printed=f"J/r^2 = {_row(printed)} kg",
                holds=all(agrees(ours[name], MASSES[name]) for name in MASSES),
                kind="number",
                why="the mass of the ring is 0.779 kg in Table 4 and 0.759 kg in (37); by (33) the "
                "values of (37) are J/r^2 and not masses",
            ),
            Claim(
                says=f"j/r^2 {_row(HALVED)} kg",
                ours=f"{_row(ours)} kg",
                printed=f"{_row(printed)} kg",
                holds=all(agrees(ours[name], HALVED[name]) for name in HALVED),
                printed_holds=all(agrees(printed[name], HALVED[name]) for name in HALVED),
                kind="number",
                why="j/r^2 is half of the row above, as for solid discs, which a ring is not",
            ),
            Claim(
                says=f"base diameters {_row(DIAMETERS, scale=1e3)} mm",
                ours=f"{_row(base, scale=1e3)} mm",
                holds=all(agrees(base[name], DIAMETERS[name]) for name in DIAMETERS),
                kind="number",
                why=f"the base diameters are pitch diameters, {_row(pitch, scale=1e3)} mm",
            ),
            Claim(
                says="single contact stiffness 2e8 N/m in every column",
                ours=f"{stiffness[0]:g} N/m at sun and ring",
                holds=agrees(stiffness, 2e8),
                kind="number",
            ),
        ),
        remarks=f"For a ring of 0.779 kg outside a pitch radius of 28 mm, j/r^2 is at least "
        f"{slim:.2f} kg at a face width of {1e3 * gearset.face_width:g} mm, and at any width at "
        "least its mass. A contact stiffness of the carrier has no meaning, because it has no "
        "teeth.",
        figures={"default": ours, "printed": printed, "base_diameters": base},
    )


def _masses(scene: Scene) -> dict[str, float]:
    data = scene.gearset.rim_masses
    return {name: getattr(data, name) for name in MASSES}


def _least_ring_inertia(inner: float, width: float) -> float:
    """j/r^2 [kg] of a steel annulus of Table 4's mass around the pitch circle."""
    outer_squared = inner**2 + MASSES["ring"] / (math.pi * STEEL * width)
    return 0.5 * MASSES["ring"] * (1.0 + outer_squared / inner**2)
