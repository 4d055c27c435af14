"""Minimax polynomials in u = |phi|^2 for cos(|phi|/2) and sin(|phi|/2)/|phi|, |phi| <= 0.5, by the Remez exchange.

Prints the coefficient lists of src/rotvec_internal.h. Needs mpmath.  SPDX-License-Identifier: MIT
"""

from mpmath import cos, lu_solve, matrix, mp, mpf, polyval, sin, sqrt

U_MAX = mpf("0.25")
GRID = 4000  # points on which the error's extremes are looked for
mp.dps = 40


def half_cos(u):
    return cos(sqrt(u) / 2)


def half_sinc(u):
    return sin(sqrt(u) / 2) / sqrt(u) if u else mpf("0.5")


def remez(f, degree):
    """Coefficients, lowest power first, and the largest error."""
    n = degree + 2
    x = [U_MAX * (1 - cos(mp.pi * k / (n - 1))) / 2 for k in range(n)]
    grid = [U_MAX * k / GRID for k in range(GRID + 1)]
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


for name, degree in (("double", 4), ("float", 2)):
    for label, f in (("cos(|phi|/2)", half_cos), ("sin(|phi|/2)/|phi|", half_sinc)):
        c, error = remez(f, degree)
        print(name, label, "error", mp.nstr(error, 3))
        for value in c:
            print("   ", mp.nstr(value, 18 if name == "double" else 10))
