"""Six accelerometers of a scenario, as the emulator takes them."""

from typing import Any

import numpy as np

from libins import _run
from libins.sixacc_tables import COUNT, G_M_S2, SixAcc


def accels_of(table: SixAcc, seed: int) -> Any:
    """The sensors. Raises ValueError."""
    accels = _run.accels_paper(table.rho_m, table.range_g * G_M_S2)
    accels.seed = seed
    accels.turn_on_m_s2 = table.turn_on_m_s2
    for key in ("bias_m_s2", "scale_error", "quadratic_s2_m"):
        accels.set(key, getattr(table, key))
    accels.set("noise_m_s2", [table.noise_lsb * table.lsb_m_s2] * COUNT)
    if table.axis is not None:
        accels.axis = table.axis
    accels.axis = turned(accels.axis, accels.place_m, table.misalignment_rad)
    if table.place_m is not None:
        accels.place_m = table.place_m
    return accels


def turned(axis: Any, place: Any, misalignment_rad: Any) -> Any:
    """Each axis u turned by its two angles: u + m1 e1 + m2 e2 at u's length, e1 along the arm, e2 = u x e1."""
    u, r, m = np.array(axis), np.array(place), np.array(misalignment_rad)
    length = np.linalg.norm(u, axis=1, keepdims=True)
    e1 = r / np.linalg.norm(r, axis=1, keepdims=True)
    off = u / length + m[:, :1] * e1 + m[:, 1:] * np.cross(u / length, e1)
    return (length * off / np.linalg.norm(off, axis=1, keepdims=True)).tolist()
