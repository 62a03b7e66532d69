"""All entries in the order of the paper."""

from __future__ import annotations

from collections.abc import Callable

from planetary_twin_py.plots import style

from . import (
    contact,
    degrees_of_freedom,
    film,
    frequencies,
    friction,
    mesh_stiffness,
    planet_forces,
    power_loss,
    stick_diagram,
    stribeck,
    tables,
    tooth_pair,
)
from .entry import Entry
from .evidence import Evidence

BUILDERS: tuple[Callable[[Evidence], Entry], ...] = (
    stick_diagram.bodies,
    tables.geometry,
    tables.oil,
    tables.masses,
    frequencies.natural_frequencies,
    stick_diagram.stick_diagram,
    tooth_pair.tooth_pair,
    contact.regulatory_factor,
    mesh_stiffness.meshing_cycle,
    contact.contact_model,
    stribeck.stribeck_curve,
    friction.viscous_friction,
    friction.boundary_friction,
    planet_forces.planet_forces,
    film.film_thickness,
    power_loss.power_loss,
    degrees_of_freedom.degrees_of_freedom,
    frequencies.against_stiffness,
    frequencies.mode_shapes,
    stick_diagram.assembly,
)


def entries(evidence: Evidence, progress: Callable[[str], None] = lambda _: None) -> list[Entry]:
    """All tables and figures.

    Args:
        evidence: scenes and studies.
        progress: called with the number of each completed entry.

    Returns:
        The entries in the order of the paper.
    """
    found = []
    with style.applied():
        for build in BUILDERS:
            found.append(build(evidence))
            progress(found[-1].number)
    return found
