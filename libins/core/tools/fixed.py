"""Integer coefficients of src/q31_internal.h: (cos(x) - 1) / u and (sin(x) / (2 x) - 1/2) / u, x = sqrt(u) / 2, u <= 1/4, as
parabolas through the Chebyshev points (within a few percent of minimax). Needs mpmath.  SPDX-License-Identifier: MIT
"""

from mpmath import chebyfit, cos, mp, mpf, nstr, sin, sqrt

U_MAX = mpf("0.25")
mp.dps = 40


def half_cos(u: mpf) -> mpf:
    return (cos(sqrt(u) / 2) - 1) / u


def half_sinc(u: mpf) -> mpf:
    return (sin(sqrt(u) / 2) / sqrt(u) - mpf(1) / 2) / u


for name, f, bits in (("HALF_COS", half_cos, 33), ("HALF_SINC", half_sinc, 34)):
    poly = chebyfit(f, [mpf("1e-30"), U_MAX], 3)[::-1]
    rounded = [int(mp.nint(c * 2**bits)) for c in poly]
    points = [U_MAX * k / 1000 for k in range(1, 1001)]
    error = max(abs(u * (sum(c * u**k for k, c in enumerate(rounded)) / mpf(2) ** bits - f(u))) for u in points)
    print(name, f"Q{bits}", rounded, "largest error with the rounded ones", nstr(error, 3))
