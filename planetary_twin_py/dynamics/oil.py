"""The lubrication laws of a scene as the numbers the compiled equations read."""

from __future__ import annotations

import math
from .._records import FLAG, REAL, Record, fields_of, layout, new_record
from ..lubrication.boundary import Asperities
from ..lubrication.film import FILM_LAWS, FilmLaw
from ..lubrication.hertz import contact_modulus
from ..lubrication.traction import Traction
from ..scene import Scene


# Laws and constants of the tooth contacts.
OIL = layout(
    film=fields_of(FilmLaw),
    asperities=fields_of(Asperities),
    traction=fields_of(Traction),
    contact_modulus=REAL,  # E* [Pa]
    face_width=REAL,  # L [m]
    viscosity=REAL,  # eta0 [Pa s]
    roughness=REAL,  # sigma [m]
    prescribed=FLAG,  # lambda ratio: prescribed, or film/roughness
    sliding_threshold=REAL,  # [-]
)


def build_oil(scene: Scene) -> Record:
    """Collect the constants of the laws a scene chooses."""
    data = scene.lubrication
    modulus = contact_modulus(data.youngs_modulus, data.poisson_ratio)
    roughness_squared = math.pi * data.roughness_parameter**2
    return new_record(
        OIL,
        film=FILM_LAWS[data.film],
        asperities=Asperities(
            area_factor=math.pi * roughness_squared,
            pressure_factor=(
                16.0 * math.sqrt(2.0) / 15.0 * roughness_squared
                * math.sqrt(data.asperity_slope) * modulus
            ),
            shear_stress=data.shear_stress,
            pressure_coefficient=data.pressure_coefficient,
        ),
        traction=Traction(
            shear_stress=data.shear_stress,
            pressure_viscosity=data.pressure_viscosity,
            conductivity_group=(
                2.0 * data.oil_conductivity * data.viscosity / data.temperature_viscosity
            ),
            film_heating=(
                4.0 / math.pi * data.oil_conductivity
                / math.sqrt(
                    2.0 * modulus * data.solid_conductivity
                    * data.solid_density * data.solid_heat_capacity
                )
            ),
        ),
        contact_modulus=modulus,
        face_width=scene.gearset.face_width,
        viscosity=data.viscosity,
        roughness=data.composite_roughness,
        prescribed=data.lambda_ratio == "prescribed",
        sliding_threshold=data.sliding_threshold,
    )
