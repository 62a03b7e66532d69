"""exp, log, sine and cosine that LLVM can vectorise inside a loop, unlike calls into the C library.

Relative error below 1e-11 for `exp`, absolute error below 1e-12 for `log`, to the last digits for
`precise_exp` and `sin_cos`, checked in the tests.
"""

from __future__ import annotations

import math
from typing import Any

from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from ._compile import law

_LN2_HIGH = 0.693147180369123816490
_LN2_LOW = 1.90821492927058770002e-10
_INVERSE_LN2 = 1.4426950408889634
_INVERSE_FACTORIAL = tuple(1.0 / math.factorial(n) for n in range(17))
# pi/2 in parts whose multiples by a whole number are exact (Cody and Waite 1980).
_RIGHT_ANGLE_HIGH = 1.57079632673412561417
_RIGHT_ANGLE_MIDDLE = 6.07710050630396597660e-11
_RIGHT_ANGLE_LOW = 2.02226624879595063154e-21
_INVERSE_RIGHT_ANGLE = 0.63661977236758134308


@intrinsic
def _bits_of(typingctx: Any, value: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.bitcast(args[0], ir.IntType(64))

    return types.int64(types.float64), codegen


@intrinsic
def _real_of(typingctx: Any, value: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.bitcast(args[0], ir.DoubleType())

    return types.float64(types.int64), codegen


@intrinsic
def _rounded_difference(typingctx: Any, value: Any, other: Any) -> Any:
    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        return builder.fsub(*args, flags=("nsz",))  # numba adds no flags where there are some

    return types.float64(types.float64, types.float64), codegen


# What a kernel sees.
_bits: Any = _bits_of
_from_bits: Any = _real_of
# A difference that the compiler does not take together with others, which would round once for
# all: what is left of an argument less many periods needs them one by one.
_less: Any = _rounded_difference


@law
def exp(x: float) -> float:
    """e**x for any finite x, saturating at the ends of the double range."""
    x = min(max(x, -700.0), 700.0)
    n = int(x * _INVERSE_LN2 + 1024.5) - 1024  # round: the offset makes truncation a floor
    r = (x - n * _LN2_HIGH) - n * _LN2_LOW
    p = _INVERSE_FACTORIAL[11]
    p = _INVERSE_FACTORIAL[10] + r * p
    p = _INVERSE_FACTORIAL[9] + r * p
    p = _INVERSE_FACTORIAL[8] + r * p
    p = _INVERSE_FACTORIAL[7] + r * p
    p = _INVERSE_FACTORIAL[6] + r * p
    p = _INVERSE_FACTORIAL[5] + r * p
    p = _INVERSE_FACTORIAL[4] + r * p
    p = _INVERSE_FACTORIAL[3] + r * p
    p = _INVERSE_FACTORIAL[2] + r * p
    p = _INVERSE_FACTORIAL[1] + r * p
    p = _INVERSE_FACTORIAL[0] + r * p
    return p * _from_bits((n + 1023) << 52)


@law
def precise_exp(x: float) -> float:
    """e**x to the last digits for x <= 0, saturating at the end of the double range."""
    x = max(x, -700.0)
    n = int(x * _INVERSE_LN2 + 1024.5) - 1024
    r = _less(_less(x, n * _LN2_HIGH), n * _LN2_LOW)
    p = _INVERSE_FACTORIAL[14]
    p = _INVERSE_FACTORIAL[13] + r * p
    p = _INVERSE_FACTORIAL[12] + r * p
    p = _INVERSE_FACTORIAL[11] + r * p
    p = _INVERSE_FACTORIAL[10] + r * p
    p = _INVERSE_FACTORIAL[9] + r * p
    p = _INVERSE_FACTORIAL[8] + r * p
    p = _INVERSE_FACTORIAL[7] + r * p
    p = _INVERSE_FACTORIAL[6] + r * p
    p = _INVERSE_FACTORIAL[5] + r * p
    p = _INVERSE_FACTORIAL[4] + r * p
    p = _INVERSE_FACTORIAL[3] + r * p
    p = _INVERSE_FACTORIAL[2] + r * p
    p = _INVERSE_FACTORIAL[1] + r * p
    p = _INVERSE_FACTORIAL[0] + r * p
    return p * _from_bits((n + 1023) << 52)


@law
def sin_cos(x: float) -> tuple[float, float]:
    """Sine and cosine of 0 <= x <= 1e5."""
    n = int(x * _INVERSE_RIGHT_ANGLE + 0.5)
    r = _less(_less(x, n * _RIGHT_ANGLE_HIGH), n * _RIGHT_ANGLE_MIDDLE)
    r = _less(r, n * _RIGHT_ANGLE_LOW)
    q = r * r
    s = -_INVERSE_FACTORIAL[15]
    s = _INVERSE_FACTORIAL[13] + q * s
    s = -_INVERSE_FACTORIAL[11] + q * s
    s = _INVERSE_FACTORIAL[9] + q * s
    s = -_INVERSE_FACTORIAL[7] + q * s
    s = _INVERSE_FACTORIAL[5] + q * s
    s = -_INVERSE_FACTORIAL[3] + q * s
    s = r + r * q * s
    c = _INVERSE_FACTORIAL[16]
    c = -_INVERSE_FACTORIAL[14] + q * c
    c = _INVERSE_FACTORIAL[12] + q * c
    c = -_INVERSE_FACTORIAL[10] + q * c
    c = _INVERSE_FACTORIAL[8] + q * c
    c = -_INVERSE_FACTORIAL[6] + q * c
    c = _INVERSE_FACTORIAL[4] + q * c
    c = -_INVERSE_FACTORIAL[2] + q * c
    c = 1.0 + q * c
    sine, cosine = (c, s) if n & 1 else (s, c)
    return (-sine if n & 2 else sine), (-cosine if (n + 1) & 2 else cosine)


@law
def log(x: float) -> float:
    """Natural logarithm of a positive normal number."""
    mantissa, exponent = _split(x)
    return _log_of((mantissa - 1.0) / (mantissa + 1.0), exponent)


@law
def logs(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Natural logarithms of three positive normal numbers, with one division for all."""
    a, i = _split(x)
    b, j = _split(y)
    c, k = _split(z)
    p, q, r = a + 1.0, b + 1.0, c + 1.0
    inverse = 1.0 / (p * q * r)
    first = _log_of((a - 1.0) * (q * r * inverse), i)
    second = _log_of((b - 1.0) * (p * r * inverse), j)
    return first, second, _log_of((c - 1.0) * (p * q * inverse), k)


@law
def _split(x: float) -> tuple[float, int]:
    """Mantissa in [sqrt(1/2), sqrt(2)), where the series is shortest, and exponent."""
    bits = _bits(x)
    exponent = ((bits + 0x95F619980C433) >> 52) - 1023
    return _from_bits(bits - (exponent << 52)), exponent


@law
def _log_of(t: float, exponent: int) -> float:
    """2 artanh(t) + exponent log(2)."""
    q = t * t
    series = 1.0 / 15.0
    series = 1.0 / 13.0 + q * series
    series = 1.0 / 11.0 + q * series
    series = 1.0 / 9.0 + q * series
    series = 1.0 / 7.0 + q * series
    series = 1.0 / 5.0 + q * series
    series = 1.0 / 3.0 + q * series
    series = 1.0 + q * series
    return 2.0 * t * series + exponent * (_LN2_HIGH + _LN2_LOW)
