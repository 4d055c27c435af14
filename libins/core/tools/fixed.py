"""Integer coefficients of src/q31_internal.h, u = |phi|^2 <= 1/4, each with the largest error of its polynomial. Needs mpmath.

cos(x) - 1 = -u/8 + u^2 (c2 - c3 u) and 1/2 - sin(x) / (2 x) = u (s1 - u (s2 - s3 u)), x = sqrt(u) / 2: c3 and s3 are chosen to be
of 8 bits, the others follow by least squares at Chebyshev points, weighted as the error is.  SPDX-License-Identifier: MIT
"""

from mpmath import cos, lu_solve, matrix, mp, mpf, nstr, pi, sin, sqrt

mp.dps = 40
POINTS = 40
u_at = [mpf("0.125") * (1 + cos(pi * (2 * k + 1) / (2 * POINTS))) for k in range(POINTS)]


def cosine(u: mpf) -> mpf:
    return cos(sqrt(u) / 2) - 1 + u / 8


def sinc(u: mpf) -> mpf:
    return mpf(1) / 2 - sin(sqrt(u) / 2) / sqrt(u)


# what, the powers of u to find and their binary places, the power given with its value
for name, f, powers, given in (
    ("COS", cosine, {2: 36}, (3, mpf(-91) / 2**22)),
    ("SINC", sinc, {1: 36, 2: 41}, (3, mpf(208) / 2**27)),
):
    rest = matrix([f(u) - given[1] * u ** given[0] for u in u_at])
    found = lu_solve(matrix([[u**k for k in powers] for u in u_at]), rest)
    rounded = {k: int(mp.nint(found[i] * 2**bits)) for i, (k, bits) in enumerate(powers.items())}
    total = [sum(c * u**k / mpf(2) ** powers[k] for k, c in rounded.items()) + given[1] * u ** given[0] for u in u_at]
    print(
        name,
        {k: abs(c) for k, c in rounded.items()},
        "largest error",
        nstr(max(abs(t - f(u)) for t, u in zip(total, u_at, strict=True)), 3),
    )
