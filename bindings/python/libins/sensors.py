"""Where a scenario's sensors go, its GPS and its GPS-enabled IMU, as the emulator takes them."""

import math
from typing import Any

import numpy as np

from libins import _run
from libins.motions import motion_of
from libins.net_scenario import NetScenario
from libins.scenario import Scenario
from libins.sensor_tables import Gimu, Gps, Track

OF_CHANNELS = ("null_v", "drift_v_s", "scale_error", "sensitivity", "bandwidth_hz", "noise_density")
OF_PART = ("vcc_v", "power_up_s", "baud", "nmea_baud", "nmea_delay_s", "order", "no_fix", "geoid_m", "utc_s")
OF_GPS = ("period_s", "latency_s", "white_m", "markov_m", "markov_tau_s", "velocity_m_s", "sats", "hdop", "first_fix_s")


def track_of(scenario: NetScenario | Scenario) -> Any:
    """Where the vehicle goes. Raises ValueError."""
    track: Track = scenario.tables.track
    return built_track(_run, track, motion_of(scenario) if track.by_motion else None, scenario.path_csv)


def site_of(ins: Any, track: Track) -> Any:
    """The origin, of the module ins."""
    latitude, longitude = math.radians(track.latitude_deg), math.radians(track.longitude_deg)
    return ins.Site(latitude, longitude, track.height_m, track.gravity, track.rotating)


def built_track(ins: Any, track: Track, attitude: Any, path_csv: np.ndarray[Any, Any] | None) -> Any:
    """A track of the module ins, libins._run or libins._truth; path_csv: its file. Raises ValueError."""
    site = site_of(ins, track)
    cruise_s = math.inf if track.cruise_s is None else track.cruise_s
    speed = (track.speed_m_s, track.start_s, track.accelerate_s, cruise_s, track.brake_s)
    if track.kind == "line":
        return ins.track_line(site, track.heading_rad, track.climb_rad, speed, attitude)
    if track.kind == "circle":
        return ins.track_circle(site, track.heading_rad, track.radius_m, speed, attitude)
    if track.kind == "eight":
        return ins.track_eight(site, track.heading_rad, track.length_m, track.width_m, speed, attitude)
    if track.kind == "csv":
        assert path_csv is not None
        t, north, east, up = path_csv.T.tolist()
        return ins.track_waypoints(site, t, north, east, up, attitude)
    return ins.track_still(site, attitude)


def gps_of(table: Gps, seed: int) -> Any:
    """The receiver; None: never a fix."""
    return built_gps(_run, table, seed)


def built_gps(ins: Any, table: Gps, seed: int) -> Any:
    """The receiver of the module ins; None: never a fix."""
    if table.preset == "none":
        return None
    gps = ins.gps_ideal() if table.preset == "ideal" else ins.gps_default()
    gps.seed = seed
    for key in OF_GPS:
        if (value := getattr(table, key)) is not None:
            setattr(gps, key, value)
    gps.set_outages([(begin, end) for begin, end in table.outages_s])
    return gps


def gimu_of(table: Gimu, seed: int) -> Any:
    """The part's configuration. Raises ValueError."""
    gimu = _run.gimu_thesis() if table.preset == "thesis" else _run.gimu_ideal()
    gimu.seed = seed
    for key in OF_CHANNELS:
        if (values := getattr(table, key)) is not None:
            gimu.set(key, values)
    for key in OF_PART:
        if (value := getattr(table, key)) is not None:
            setattr(gimu, key, value)
    if table.clock_ppm is not None:
        gimu.clock_ppb = round(table.clock_ppm * 1e3)
    return gimu
