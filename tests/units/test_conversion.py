"""Quantities as people write them: each is read right, or refused with what is wrong about it."""

import math
import time

import numpy as np
import pint
import pytest
from tiers import first_rows

from planetary_twin_py.units.conversion import _COMMON, UnitError, column_to_si, to_si


@pytest.mark.parametrize(
    ("written", "unit", "meant"),
    [
        ("40.5 N m", "N m", 40.5),
        ("40 Nm", "N m", 40.0),
        ("-.5e-3 mm", "m", -5e-7),
        ("70 °C", "K", 343.15),
        ("46 W/(m degC)", "W/(m K)", 46.0),
        ("206 kN/mm2", "Pa", 206e9),
        ("890 kg m-3", "kg/m^3", 890.0),
        ("20 %", "", 0.2),
        *(
            (f"1 {unit}", "N m", 1.3558179483314004)
            for unit in ("ft-lb", "lb-ft", "lbf·ft", "ft-lbf", "ft lb", "FT-LBS", "lbf*ft", "ftlb")
        ),
        *((f"1 {unit}", "N m", 0.1129848290276167) for unit in ("in-lb", "lbf·in", "lb-in")),
        *((f"1 {unit}", "N m", 0.0070615518142260) for unit in ("oz-in", "ozf-in", "in·oz")),
        *((f"1 {unit}", "N m", 9.80665) for unit in ("kgf-m", "kgf·m", "kg-m")),
        *((f"1 {unit}", "N m", 1.0) for unit in ("N-m", "N.m", "N*m", "NM")),
        *((f"1 {unit}", "N m", 0.01) for unit in ("Ncm", "N-cm", "N·cm")),
        ("1 kN-m", "N m", 1e3),
        ("1 Nmm", "N m", 1e-3),
        *((f"30 {unit}", "rad/s", math.pi) for unit in ("r/min", "RPM", "Rpm", "U/min", "tr/min")),
        *((f"180 {unit}", "rad/s", math.pi) for unit in ("dps", "deg/s", "°/s")),
        *((f"80 {unit}", "Pa s", 0.08) for unit in ("mPas", "mPa-s", "mPa·s", "cP")),
        ("1 MPas", "Pa s", 1e6),
        *((f"1 {unit}", "m", 1e-6) for unit in ("µm", "μm", "micron", "um")),
        *((f"70 {unit}", "K", 343.15) for unit in ("deg C", "Celsius", "º C", "℃")),
        ("158 deg F", "K", 343.15),
        *((f"1 {unit}", "m/s^2", 9.80665) for unit in ("g", "g_n")),
        *((f"2 {unit}", "m/s^2", 2.0) for unit in ("m/s2", "m/s²")),
        ("1 lb", "N", 4.4482216152605),
        ("1 lb", "kg", 0.45359237),
        ("1 in-lb/rad", "N m/rad", 0.1129848290276167),
    ],
)
def test_a_number_with_a_unit_is_converted_to_si(written, unit, meant):
    assert to_si(written, unit) == pytest.approx(meant, rel=1e-12)


@pytest.mark.parametrize(("given", "unit"), first_rows(4, _COMMON), ids=lambda name: name)
def test_frequent_units_have_the_bits_of_the_library(given, unit):
    rng = np.random.default_rng(1)
    values = rng.normal(size=2000) * 10.0 ** rng.uniform(-9.0, 9.0, 2000)
    library = pint.UnitRegistry(autoconvert_offset_to_baseunit=True)
    expected = library.Quantity(values, given).to(unit).magnitude
    assert np.array_equal(column_to_si(values, given, unit), expected)


@pytest.mark.parametrize("written", ["40,5 N m", "1.000,5 N m", "40,5", "1,000 N m", "(4,5) N m"])
def test_a_comma_is_never_dropped(written):
    with pytest.raises(UnitError, match="write a decimal point, not a comma"):
        to_si(written, "N m")


@pytest.mark.parametrize("written", ["1'000 N m", "1 300 N m", "2*3 N m", "1.000.5 N m", "−5 N m"])
def test_no_sign_that_is_not_understood_is_dropped(written):
    with pytest.raises(ValueError, match=r"cannot be converted|is not a number with a unit"):
        to_si(written, "N m")


@pytest.mark.parametrize(
    ("given", "unit", "advice"),
    [
        ("1/min", "rad/s", "; write rpm or rev/s for turns"),
        ("min-1", "rad/s", "; write rpm or rev/s for turns"),
        ("Hz", "rad/s", "; write rpm or rev/s for turns"),
        ("C", "K", "; write degC"),
        ("F", "K", "; write degF"),
        ("cSt", "Pa s", "; dynamic viscosity = kinematic viscosity x density"),
        ("mm2/s", "Pa s", "; dynamic viscosity = kinematic viscosity x density"),
        ("kg m^2", "kg", "; it is J/r^2 of a moment of inertia J"),
        ("Mpa", "Pa", "; write MPa"),
        ("kN", "N m", "; write, for example, N m or kN m"),
        ("V", "rad/s", "; write, for example, rad/s or rpm"),
        ("C", "m", "; write, for example, m or mm or um"),
        ("furlongz", "m", "; write, for example, m or mm or um"),
        ("MPas", "m", "; write, for example, m or mm or um"),
    ],
)
def test_wrong_unit_is_named_with_expected_one_and_an_example(given, unit, advice):
    message = f"[{given}] cannot be converted to {unit}{advice}"
    for read in (
        lambda: to_si(f"70 {given}", unit),
        lambda: column_to_si(np.array([70.0]), given, unit),
    ):
        with pytest.raises(UnitError) as refusal:
            read()
        assert str(refusal.value) == message


def test_an_unknown_unit_is_no_number_without_a_unit():
    with pytest.raises(UnitError, match=r"\[furlongz\] cannot be converted to 1"):
        to_si("0.2 furlongz", "")


@pytest.mark.parametrize(
    "unit",
    [
        "10**10**10 W",
        "W**10**10",
        "(10**99)**99",
        "min99999999",
        "10⁹⁹⁹⁹⁹⁹⁹⁹⁹",
        "W^9^9^9",
        "m" * 99,
    ],
)
def test_a_unit_whose_powers_have_no_end_is_refused_at_once(unit):
    start = time.process_time()
    with pytest.raises(UnitError, match="cannot be converted to W"):
        column_to_si(np.ones(1), unit, "W")
    assert time.process_time() - start < 2.0
