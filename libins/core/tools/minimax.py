"""Minimax polynomials by the Remez exchange: in u = |phi|^2 for cos(|phi|/2) and sin(|phi|/2)/|phi|, |phi| <= 0.5, and in
the square of the sine of the latitude for the Earth's radii.

Prints the coefficient lists of src/rotvec_internal.h and src/earth_internal.h. Needs mpmath.  SPDX-License-Identifier: MIT
"""

from mpmath import cos, lu_solve, matrix, mp, mpf, polyval, sin, sqrt

GRID = 4000  # points on which the error's extremes are looked for
mp.dps = 40
U_MAX = mpf("0.25")
WGS84_F = 1 / mpf("298.257223563")
WGS84_E2 = WGS84_F * (2 - WGS84_F)


def half_cos(u):
    return cos(sqrt(u) / 2)


def half_sinc(u):
    return sin(sqrt(u) / 2) / sqrt(u) if u else mpf("0.5")


def per_w(s2):
    """N / a, the radius of the prime vertical."""
    return 1 / sqrt(1 - WGS84_E2 * s2)


def remez(f, degree, top):
    """Coefficients, lowest power first, and the largest error on 0 .. top."""
    n = degree + 2
    x = [top * (1 - cos(mp.pi * k / (n - 1))) / 2 for k in range(n)]
    grid = [top * k / GRID for k in range(GRID + 1)]
    values = [f(u) for u in grid]
    for _ in range(12):
        a = matrix(n, n)
        b = matrix(n, 1)
        for i in range(n):
            for j in range(degree + 1):
                a[i, j] = x[i] ** j
            a[i, degree + 1] = (-1) ** i
            b[i] = f(x[i])
        solution = lu_solve(a, b)
        c = list(solution)[: degree + 1]
        error = [polyval(c[::-1], u) - v for u, v in zip(grid, values, strict=True)]
        peaks = []
        for k, e in enumerate(error):
            if peaks and (e > 0) == (error[peaks[-1]] > 0):
                if abs(e) > abs(error[peaks[-1]]):
                    peaks[-1] = k
            else:
                peaks.append(k)
        x = [grid[k] for k in peaks]
        assert len(x) == n, "the error does not alternate"
    return c, max(abs(e) for e in error)


FUNCTIONS = (
    ("cos(|phi|/2)", half_cos, U_MAX, {"double": 4, "float": 2}),
    ("sin(|phi|/2)/|phi|", half_sinc, U_MAX, {"double": 4, "float": 2}),
    ("1/W", per_w, mpf(1), {"double": 5, "float": 2}),
)
for name, digits in (("double", 18), ("float", 10)):
    for label, f, top, degrees in FUNCTIONS:
        c, error = remez(f, degrees[name], top)
        print(name, label, "error", mp.nstr(error, 3))
        for value in c:
            print("   ", mp.nstr(value, digits))
