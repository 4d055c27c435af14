"""The navigator of six accelerometers, as a scenario describes it, and what came out."""

import math
from typing import Any

import numpy as np

from libins import _run
from libins.scenario import Scenario
from libins.sensors import gps_of

STATE_COLUMNS = (*_run.STATE_COLUMNS, *_run.SIX_COLUMNS)
PLACE = {name: i for i, name in enumerate(STATE_COLUMNS)}
GPS_LEAST_M = 0.01
"""What the navigator takes an ideal receiver for."""
BIAS_LEAST_M_S2 = 1e-4
"""And accelerometers that are always the same."""


def nav_of(scenario: Scenario, nav: Any, accels: Any, seed: int) -> Any:
    """Their navigator: it knows the accelerometers but for noise and turn-on bias. Raises ValueError."""
    tables = scenario.tables
    sixacc, told = tables.sixacc, tables.gyro_free
    assert sixacc is not None and tables.nav is not None
    lsb = sixacc.lsb_m_s2
    noise = lsb * math.sqrt(sixacc.noise_lsb**2 + 1 / 12)
    bias = max(sixacc.turn_on_m_s2, BIAS_LEAST_M_S2) if told.bias_m_s2 is None else told.bias_m_s2
    start = (*told.attitude_rad, told.velocity_m_s, told.position_m, told.rate_rad_s)
    filtered = (noise, bias, told.bias_walk_m_s2_rts, *start, told.gate)
    still = (told.still_s, told.still_m_s, told.still_rad_s)
    six = _run.SixNav(nav, accels, lsb, tables.nav.skew_s, filtered, still, seed)
    six.gps = gps_of(tables.gps, seed)
    if six.gps is not None:
        errors = zip(six.gps.white_m, six.gps.markov_m, strict=True)
        six.gps_sigma_m = told.gps_m or [max(math.hypot(*each), GPS_LEAST_M) for each in errors]
    return six


def solved(states: Any) -> dict[str, Any]:
    """The summary's `position` and `gyro_free`: errors, and what the filter says of them at the end."""
    if not len(states):
        return {"position": None, "gyro_free": None}
    level = np.hypot(states[:, PLACE["error_p_n_m"]], states[:, PLACE["error_p_e_m"]])
    turn = np.linalg.norm(states[:, PLACE["error_phi_n_rad"] : PLACE["error_phi_d_rad"] + 1], axis=1)
    last = states[-1]
    return {
        "position": {
            "rms_m": math.sqrt(math.fsum((level * level).tolist()) / len(level)),
            "max_m": float(level.max()),
            "last_m": float(level[-1]),
        },
        "gyro_free": {
            "attitude_max_rad": float(turn.max()),
            "attitude_last_rad": float(turn[-1]),
            "sigma_attitude_rad": last[PLACE["sigma_phi_n_rad"] : PLACE["sigma_phi_d_rad"] + 1].tolist(),
            "sigma_position_m": last[PLACE["sigma_p_n_m"] : PLACE["sigma_p_d_m"] + 1].tolist(),
            "fixes": int(last[PLACE["fixes"]]),
            "refused": int(last[PLACE["refused"]]),
        },
    }
