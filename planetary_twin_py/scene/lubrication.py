"""Oil, surfaces and friction laws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal, Self

from pydantic import Field, model_validator

from .._core import TRACTION_LAWS, WITHOUT_BOUNDARY
from ..lubrication.viscosity_grade import GRADES, HIGHEST_INDEX, LOWEST_INDEX
from ..units.conversion import to_si
from .friction_table import FrictionTable
from .oil_grade import with_grade
from .quantity import Section, quantity

if TYPE_CHECKING:
    TractionLaw = str
else:
    TractionLaw = Literal[tuple(sorted(TRACTION_LAWS))]  # the laws that are compiled

MINERAL_INDEX = 95.0  # of mineral gear oils, for which ISO 3448 lists viscosities
DENSITY = 890.0  # [kg/m^3]


class Lubrication(Section):
    """Oil, surfaces, and laws for film thickness, lambda ratio and friction.

    Printed forms are those of Salagianni et al. 2017: asperity functions of the appendix,
    traction (12) without thermal coefficient and lower limit, one modulus E' in (11) to (15).
    """

    friction: bool = Field(True, description="tooth friction on or off")
    friction_torque: Literal["sliding", "printed"] = Field(
        "sliding",
        description="sliding: -f dVs/dw, dissipates f Vs; printed: P/w, Salagianni (17)-(20)",
    )
    film: Literal["dowson_higginson", "dowson_toyoda", "salagianni"] = Field(
        "dowson_higginson",
        description="law of the film thickness; salagianni: (15) of Salagianni et al.",
    )
    lambda_ratio: Literal["prescribed", "computed"] = Field(
        "computed",
        description="prescribed: by the operating point; computed: film/composite roughness",
    )
    asperities: Literal["exact", "printed"] = Field(
        "exact", description="functions F_2, F_5/2; printed: polynomials of the paper's appendix"
    )
    boundary: Literal["greenwood_tripp", "load_sharing"] = Field(
        "load_sharing", description="law of boundary friction"
    )
    traction: TractionLaw = Field(
        "eyring",
        description="law of viscous friction; eyring: shear-thinning film up to its limiting "
        "stress; evans_johnson: plateau under heavy load; printed: (12) of Salagianni et al.; "
        "schlenk: regression of gear losses, includes boundary friction; table: friction_table",
    )
    friction_table: FrictionTable | None = Field(
        None, description="friction coefficient over its quantities, for traction: table"
    )
    modulus: Literal["by_equation", "printed"] = Field(
        "by_equation", description="by_equation: E* in (11), 2 E* in (13) and (15)"
    )
    rolling: Literal["none", "goksem_hargreaves"] = Field(
        "none", description="law of rolling resistance"
    )
    iso_vg: int | None = Field(
        None,
        description="viscosity grade of ISO 3448, such as 220; defines viscosity, "
        "reference_temperature and viscosity_slope",
        ge=GRADES[0],
        le=GRADES[-1],
    )
    viscosity_index: float = quantity(
        "",
        "viscosity index of the oil (ASTM D2270), for iso_vg; about 95 for mineral gear oils",
        MINERAL_INDEX,
        ge=LOWEST_INDEX,
        le=HIGHEST_INDEX,
    )
    viscosity: float = quantity(
        "Pa s",
        "dynamic viscosity at atmospheric pressure and the reference temperature",
        ge=1e-3,
        le=10.0,
    )
    reference_temperature: float = quantity(
        "K", "temperature to which `viscosity` refers", 343.15, ge=233.15, le=433.15
    )
    viscosity_slope: float = quantity(
        "",
        "B of Walther's equation (ASTM D341); default: VG 460, 460 and 30.5 mm^2/s at 40, 100 C",
        3.2975,
        ge=0.0,
        le=6.0,
    )
    oil_density: float = quantity("kg/m^3", "density of the oil", DENSITY, ge=500.0, le=2000.0)
    pressure_viscosity: float = quantity(
        "1/Pa", "pressure coefficient of the viscosity", gt=0.0, le=1e-6
    )
    temperature_viscosity: float = quantity("1/K", "thermal coefficient", 0.04, gt=0.0, le=1.0)
    shear_stress: float = quantity("Pa", "Eyring stress", gt=0.0, le=1e9)
    limiting_stress: float = quantity(
        "", "limiting shear stress/pressure of the oil, for eyring", 0.047, gt=0.0, le=0.2
    )
    oil_factor: float = quantity(
        "", "X_L of the oil, 1 for mineral oil, for schlenk", 1.0, gt=0.0, le=2.0
    )
    oil_conductivity: float = quantity(
        "W/(m K)", "thermal conductivity of the oil", 0.137, gt=0.0, le=1e4
    )
    solid_conductivity: float = quantity(
        "W/(m K)", "thermal conductivity of the gears", 46.0, gt=0.0, le=1e4
    )
    solid_density: float = quantity("kg/m^3", "density of the gears", 7800.0, gt=0.0, le=1e5)
    solid_heat_capacity: float = quantity(
        "J/(kg K)", "specific heat of the gears", 470.0, gt=0.0, le=1e5
    )
    youngs_modulus: float = quantity("Pa", "Young's modulus of the gears", 206e9, gt=0.0, le=1e12)
    poisson_ratio: float = quantity("", "Poisson ratio of the gears", 0.3, ge=0.0, lt=0.5)
    roughness_parameter: float = quantity(
        "", "xi beta sigma of the asperities", 0.055, gt=0.0, le=1.0
    )
    asperity_slope: float = quantity("", "sigma/beta of the asperities", 0.001, gt=0.0, le=1.0)
    pressure_coefficient: float = quantity("", "eps of the boundary film", 0.17, ge=0.0, le=1.0)
    boundary_coefficient: float = quantity(
        "", "friction coefficient without a film, for load sharing", 0.11, ge=0.0, le=1.0
    )
    composite_roughness: float = quantity(
        "m",
        "composite roughness sigma: root of Rq^2 of one flank + Rq^2 of the other; 1.77 times the "
        "Ra of two equal flanks",
        2e-7,
        gt=0.0,
        le=1e-4,
    )
    sliding_threshold: float = quantity(
        "",
        "slide-to-roll ratio at which traction reaches tanh(1) of its plateau",
        0.015,
        gt=0.0,
        le=1.0,
    )
    presliding_displacement: float = quantity(
        "m",
        "presliding displacement of static friction: elastic displacement before flanks slide",
        5e-7,
        ge=1e-9,
        le=1e-4,
    )

    @property
    def includes_boundary_friction(self) -> bool:
        """Whether the law `traction` describes all friction, so that `boundary` is not used."""
        return self.traction not in WITHOUT_BOUNDARY

    @model_validator(mode="before")
    @classmethod
    def _of_its_grade(cls, data: Any) -> Any:
        if not isinstance(data, dict) or data.get("iso_vg") is None:
            return data
        try:
            grade = float(data["iso_vg"])
            index = float(to_si(data.get("viscosity_index", MINERAL_INDEX), ""))  # type: ignore[arg-type]
            density = float(to_si(data.get("oil_density", DENSITY), "kg/m^3"))  # type: ignore[arg-type]
        except (TypeError, ValueError):
            return data  # the fields are refused one by one
        return with_grade(data, grade, index, density)

    @model_validator(mode="after")
    def _has_its_table(self) -> Self:
        if self.traction == "table" and self.friction_table is None:
            raise ValueError("traction = 'table': requires friction_table")
        return self
