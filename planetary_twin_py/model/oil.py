"""The lubrication laws of a scene as constants of the compiled equations."""

from __future__ import annotations

import math

import numpy as np

from .. import _core
from .._core import TRACTION_LAWS, Asperities, Oil, ShearThinning, Traction, half_width, prescribe
from ..lubrication.film import FILM_LAWS
from ..lubrication.hertz import contact_modulus
from ..lubrication.schlenk import log_schlenk_factor
from ..lubrication.viscosity import viscosity_at
from ..scene import OperatingPoint, Scene
from ..scene.friction_table import AXES, FrictionTable
from ..scene.lubrication import Lubrication


def build_oil(scene: Scene, point: OperatingPoint) -> Oil:
    """Collect the constants of the selected laws at the oil temperature."""
    data = scene.lubrication
    modulus = contact_modulus(data.youngs_modulus, data.poisson_ratio)
    width = scene.gearset.face_width
    contact_factor = 2.0 * width * half_width(1.0, 1.0, width, modulus)  # A/sqrt(R F)
    viscosity = viscosity_at(
        point.oil_temperature,
        (data.reference_temperature, data.viscosity),
        data.viscosity_slope,
        data.oil_density,
    )
    oil = Oil(
        film=FILM_LAWS[data.film],
        asperities=_asperities(data, modulus),
        traction_law=TRACTION_LAWS[data.traction],
        traction=_traction(data, modulus, viscosity),
        shear_thinning=_shear_thinning(data, viscosity, contact_factor, width),
        log_schlenk=log_schlenk_factor(width, viscosity, data.composite_roughness, data.oil_factor),
        contact_modulus=modulus,
        face_width=width,
        line_length=1.0 / math.cos(scene.gearset.base_helix),
        log_speed_group=math.log(viscosity / (2.0 * modulus)),
        log_material=math.log(data.pressure_viscosity * 2.0 * modulus),
        log_load_group=-math.log(2.0 * modulus * width),
        log_area=math.log(contact_factor),
        log_roughness=math.log(data.composite_roughness),
        density=data.oil_density,
        kinematic=viscosity / data.oil_density,
        prescribed=data.lambda_ratio == "prescribed",
        printed_asperities=data.asperities == "printed",
        sharing=data.boundary == "load_sharing",
        boundary_coefficient=data.boundary_coefficient,
        rolling=data.rolling == "goksem_hargreaves",
        sliding_threshold=data.sliding_threshold,
        presliding=data.presliding_displacement,
        table=_friction_table(data.friction_table),
    )
    oil.temperature[:] = point.oil_temperature
    prescribe(oil, point.lambda_ratio)
    return oil


def _friction_table(data: FrictionTable | None) -> _core.FrictionTable:
    """The table of a scene with logarithms of its quantities."""
    if data is None:
        return _core.FrictionTable()
    knots = [np.log(getattr(data, name) or (1.0,)) for name in AXES]
    table = _core.FrictionTable(size=[len(each) for each in knots], coefficient=data.coefficient)
    for row, each in zip(table.knot, knots, strict=True):
        row[: len(each)] = each
    return table


def _asperities(data: Lubrication, modulus: float) -> Asperities:
    """Constants of the asperities, from the roughness and E* [Pa]."""
    roughness_squared = math.pi * data.roughness_parameter**2
    return Asperities(
        area_factor=math.pi * roughness_squared,
        pressure_factor=(
            16.0
            * math.sqrt(2.0)
            / 15.0
            * roughness_squared
            * math.sqrt(data.asperity_slope)
            * (2.0 * modulus if data.modulus == "printed" else modulus)
        ),
        shear_stress=data.shear_stress,
        pressure_coefficient=data.pressure_coefficient,
    )


def _traction(data: Lubrication, modulus: float, viscosity: float) -> Traction:
    """Constants of the plateau, from E* [Pa] and eta0 [Pa s]."""
    printed = data.traction == "printed"
    softening = 1.0 if printed else data.temperature_viscosity
    root = (1.2 / data.shear_stress) ** 2 * 2.0 * data.oil_conductivity * viscosity / softening
    solid = data.solid_conductivity * data.solid_density * data.solid_heat_capacity
    heating = 9.6 * 4.0 / math.pi * data.oil_conductivity / math.sqrt(2.0 * modulus * solid)
    return Traction(
        shear_stress=data.shear_stress,
        pressure_viscosity=data.pressure_viscosity,
        log_root=math.log(root),
        least=-math.inf if printed else 0.0,
        log_heating=math.log(heating),
    )


def _shear_thinning(
    data: Lubrication, viscosity: float, contact_factor: float, width: float
) -> ShearThinning:
    """Constants of the film, from eta0 [Pa s], A/sqrt(R F) [(m/N)^0.5 m] and the face width [m]."""
    stress = data.shear_stress
    effusivity = math.sqrt(data.solid_conductivity * data.solid_density * data.solid_heat_capacity)
    softening = data.temperature_viscosity * stress
    # sqrt(b/V) is sqrt(R p/V) A/sqrt(R F)/sqrt(2 L).
    width_over_heat = contact_factor / math.sqrt(2.0 * width)
    return ShearThinning(
        shear_stress=stress,
        pressure_viscosity=data.pressure_viscosity,
        log_shear_time=math.log(viscosity / stress),
        limiting_stress=data.limiting_stress,
        film_heating=softening / (8.0 * data.oil_conductivity),
        flash_heating=softening * 0.5 * 1.06 / effusivity * width_over_heat,
    )
