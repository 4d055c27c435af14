"""Coning coefficients for two previous increments with the least peak drift over a band 0 < mu <= top (mu: radians of the cone's
turn in one increment), by golden section. Prints those of src/coning.c. Needs mpmath.  SPDX-License-Identifier: MIT

K1 + 2 K2 = 1/12 makes the drift vanish as mu goes to 0; K2 is free. Drift over a^2 Omega:
{2 (1 - cos mu) (K1 sin mu + K2 sin 2 mu) - (mu - sin mu) / 2} / mu
"""

from mpmath import cos, mp, mpf, nstr, sin, sqrt

GRID = 400
TAYLOR = mpf(-1) / 60  # K2 of INS_CONING_HIST2_OPT, the limit for a narrow band
mp.dps = 30


def peak(k2: mpf, top: mpf) -> mpf:
    def drift(mu: mpf) -> mpf:
        k1 = mpf(1) / 12 - 2 * k2
        return (2 * (1 - cos(mu)) * (k1 * sin(mu) + k2 * sin(2 * mu)) - (mu - sin(mu)) / 2) / mu

    return max(abs(drift(top * k / GRID)) for k in range(1, GRID + 1))


for top in (mpf("0.3"), mpf("0.6"), mpf(1)):
    low, high = mpf("-0.03"), TAYLOR
    ratio = (sqrt(5) - 1) / 2
    for _ in range(45):
        a, b = high - ratio * (high - low), low + ratio * (high - low)
        if peak(a, top) < peak(b, top):
            high = b
        else:
            low = a
    k2 = (low + high) / 2
    gain = peak(TAYLOR, top) / peak(k2, top)
    print(
        f"mu <= {nstr(top, 2)}: K2 {nstr(k2, 9)}, peak {nstr(peak(k2, top), 4)}, {nstr(gain, 3)} times below HIST2_OPT"
    )
