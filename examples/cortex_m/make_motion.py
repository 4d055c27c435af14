"""Writes motion.inc: what an IMU on a swinging mount gives, and the attitude at the end.  SPDX-License-Identifier: MIT.

    python3 make_motion.py > motion.inc

Yaw, pitch and roll (ZYX) swing from rest as a (1 - cos w t); the place is fixed on the rotating Earth. Rates and
specific force follow by calculus and are integrated over each interval by Gauss-Legendre, so the answer owes nothing to
the library. Counts are rounded as an integrating IMU rounds: what is left over goes into the next. Units: rad, m/s.
"""

import math
from collections.abc import Callable

STEPS = 500
PERIOD_S = 0.01
LATITUDE, HEIGHT_M = math.radians(25.0), 30.0
SWINGS = ((0.6, 0.21), (-0.3, 0.17), (0.4, 0.33))  # yaw, pitch, roll: amplitude [rad], frequency [Hz]
GYRO_BITS, ACCELEROMETER_BITS, QUATERNION_BITS = 31, 28, 30
EARTH_RATE = 7.292115e-5
NODES = (0.1834346424956498, 0.5255324099163290, 0.7966664774136267, 0.9602898564975363)
WEIGHTS = (0.3626837833783620, 0.3137066458778873, 0.2223810344533745, 0.1012285362903763)

Vector = tuple[float, ...]


def normal_gravity() -> float:
    """WGS-84: Somigliana, and the height's series of NIMA TR8350.2."""
    a, f, m = 6378137.0, 1 / 298.257223563, 0.00344978650684
    s2 = math.sin(LATITUDE) ** 2
    surface = 9.7803253359 * (1 + 0.00193185265241 * s2) / math.sqrt(1 - f * (2 - f) * s2)
    return surface * (1 - 2 / a * (1 + f + m - 2 * f * s2) * HEIGHT_M + 3 * HEIGHT_M**2 / a**2)


EARTH_N = (EARTH_RATE * math.cos(LATITUDE), 0.0, -EARTH_RATE * math.sin(LATITUDE))
FORCE_N = (0.0, 0.0, -normal_gravity())


def angles(t: float) -> tuple[Vector, Vector]:
    """Yaw, pitch, roll, and their rates."""
    swings = [(a, 2 * math.pi * f) for a, f in SWINGS]
    return tuple(a * (1 - math.cos(w * t)) for a, w in swings), tuple(a * w * math.sin(w * t) for a, w in swings)


def to_body(t: float, v: Vector) -> Vector:
    """A vector of n in b."""
    (yaw, pitch, roll), _ = angles(t)
    x, y = v[0] * math.cos(yaw) + v[1] * math.sin(yaw), v[1] * math.cos(yaw) - v[0] * math.sin(yaw)
    x, z = x * math.cos(pitch) - v[2] * math.sin(pitch), x * math.sin(pitch) + v[2] * math.cos(pitch)
    return x, y * math.cos(roll) + z * math.sin(roll), z * math.cos(roll) - y * math.sin(roll)


def rate(t: float) -> Vector:
    """w_ib_b."""
    (_, pitch, roll), (dyaw, dpitch, droll) = angles(t)
    earth = to_body(t, EARTH_N)
    return (
        earth[0] + droll - dyaw * math.sin(pitch),
        earth[1] + dpitch * math.cos(roll) + dyaw * math.sin(roll) * math.cos(pitch),
        earth[2] - dpitch * math.sin(roll) + dyaw * math.cos(roll) * math.cos(pitch),
    )


def integral(f: Callable[[float], Vector], k: int) -> Vector:
    """Over interval k."""
    mid, half = (k + 0.5) * PERIOD_S, PERIOD_S / 2
    terms = [(w, f(mid + sign * half * x)) for x, w in zip(NODES, WEIGHTS, strict=True) for sign in (-1, 1)]
    return tuple(half * math.fsum(w * value[i] for w, value in terms) for i in range(3))


def product(p: Vector, q: Vector) -> Vector:
    """Hamilton's, scalar first."""
    return (
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    )


def attitude(t: float) -> Vector:
    """q_nb."""
    yaw, pitch, roll = (x / 2 for x in angles(t)[0])
    level = product((math.cos(yaw), 0, 0, math.sin(yaw)), (math.cos(pitch), 0, math.sin(pitch), 0))
    return product(level, (math.cos(roll), math.sin(roll), 0, 0))


def counts(series: list[Vector], bits: int) -> list[list[int]]:
    """Sums are rounded, increments are differences of sums."""
    rounded, total = [[0, 0, 0]], [0.0, 0.0, 0.0]
    for value in series:
        total = [a + b for a, b in zip(total, value, strict=True)]
        rounded.append([round(math.ldexp(x, bits)) for x in total])
    return [[b - a for a, b in zip(*pair, strict=True)] for pair in zip(rounded, rounded[1:], strict=False)]


def main() -> None:
    """motion.inc."""
    gyro = counts([integral(rate, k) for k in range(STEPS)], GYRO_BITS)
    force = counts([integral(lambda t: to_body(t, FORCE_N), k) for k in range(STEPS)], ACCELEROMETER_BITS)
    end = STEPS * PERIOD_S
    half = EARTH_RATE * end / 2
    turned = (math.cos(half), *(x / EARTH_RATE * math.sin(half) for x in EARTH_N))
    quaternions = {
        "motion_start": attitude(0),
        "motion_end": attitude(end),
        "motion_end_inertial": product(turned, attitude(end)),
    }
    print(f"""/// \\file   motion.inc
/// \\brief  {STEPS} readings of an IMU on a swinging mount, and the true attitude. Written by make_motion.py.
/// SPDX-License-Identifier: MIT
#include <stdint.h>

#define MOTION_STEPS    {STEPS}
#define MOTION_PERIOD_S {PERIOD_S}f
#define MOTION_LATITUDE {LATITUDE:.9f}f // rad
#define MOTION_HEIGHT   {HEIGHT_M}f // m

/// Attitude q_nb, scalar first, 2^-30 a unit; the last against the n of the start, held still in inertial space.""")
    for name, q in quaternions.items():
        print(
            f"static const int32_t {name}[4] = {{{', '.join(str(round(math.ldexp(x, QUATERNION_BITS))) for x in q)}}};"
        )
    print("\n/// Angle increments x, y, z, 2^-31 rad a count; velocity increments x, y, z, 2^-28 m/s a count.")
    print("static const int32_t motion[MOTION_STEPS][6] = {")
    for theta, v in zip(gyro, force, strict=True):
        print(f"    {{{', '.join(str(x) for x in theta + v)}}},")
    print("};")


if __name__ == "__main__":
    main()
