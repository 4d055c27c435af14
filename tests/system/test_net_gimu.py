"""The GIMU as a station: what a host receives is what was sampled on the track, wherever time is cut."""

import math
import struct
from typing import Any

import numpy as np
import pytest

from libins import _run

PS_PER_S = 10**12
BAUD = 19200
SECONDS = 12
STEPS = 97
NULL = 2047
LSB_RATE = math.radians(3300 / 4095 / 4)
LSB_FORCE = 3300 / 4095 / 800 * 9.8
EARTH_RADIUS_M = 6.4e6
SPEED = (8.0, 1.0, 2.0, math.inf, 1.0)


def site(**keys: Any) -> Any:
    return _run.Site(math.radians(24.757), math.radians(120.951), 60.0, **keys)


def circle() -> Any:
    return _run.track_circle(site(), 0.3, 40.0, SPEED)


def gimu_net(config: Any = None, track: Any = None, gps: Any = None, **line: Any) -> Any:
    net = _run.Net(1)
    net.gimu("gimu", config or _run.gimu_ideal(), track or circle(), gps)
    net.host("pc", BAUD)
    net.line("gimu.T", "pc", BAUD, **line)
    return net


def packets(octets: bytes) -> list[tuple[int, ...]]:
    """Samples, then coordinates and satellites of type 2; five of type 1 and one of type 2 a second."""
    found: list[tuple[int, ...]] = []
    while octets:
        layout = ">7H2IB" if len(found) % 6 == 5 else ">7H"
        header, *values = struct.unpack_from(layout, octets)
        assert header == 0xAA55
        found.append(tuple(values))
        octets = octets[struct.calcsize(layout) :]
    return found


def go(net: Any, seconds: float, steps: int = 1) -> None:
    for k in range(1, steps + 1):
        assert net.until(round(seconds * PS_PER_S) * k // steps)


def test_a_host_receives_what_was_sampled_on_the_track() -> None:
    net, track = gimu_net(), circle()
    go(net, SECONDS)
    samples = net.take_samples("gimu")
    received = packets(net.take_octets("pc"))
    assert len(received) == len(samples) == 6 * SECONDS
    assert [p[:6] for p in received] == [tuple(row) for row in samples[:, 2:].tolist()]
    assert samples[:, 0].tolist() == list(range(6 * SECONDS))
    for _, t_ps, *raw in samples.tolist():
        truth = track.at(t_ps / PS_PER_S)
        assert np.subtract(raw[:3], NULL) * LSB_RATE == pytest.approx(truth["w_ib_b"], abs=0.501 * LSB_RATE)
        assert np.subtract(raw[3:], NULL) * LSB_FORCE == pytest.approx(truth["f_b"], abs=0.501 * LSB_FORCE)
    assert net.gimu_counters("gimu") == {
        "packets": 6 * SECONDS,
        "sentences": 2 * SECONDS,
        "clipped": 0,
        "octets": 93 * SECONDS,
    }


def test_coordinates_are_those_of_the_receiver() -> None:
    gps = _run.gps_ideal()
    gps.set_outages([[4.0, 6.0]])
    net, track = gimu_net(gps=gps), circle()
    go(net, SECONDS)
    for second, packet in enumerate(packets(net.take_octets("pc"))[5::6]):
        out = second in (4, 5)
        longitude, latitude, sats = packet[6:]
        assert sats == (0 if out else 8)
        degrees = [value // 10**6 + value % 10**6 / 600_000 for value in (latitude, longitude)]
        truth = track.at(3.0 if out else float(second))["llh"]
        assert degrees == pytest.approx(np.degrees(truth[:2]), abs=0.501e-4 / 60)


@pytest.mark.parametrize("line", [{}, {"delay_s": 1e-9}, {"bit_error": 2e-3, "octet_loss": 0.02}])
def test_no_result_depends_on_where_time_is_cut(line: dict[str, float]) -> None:
    def heard(steps: int) -> tuple[Any, ...]:
        net = gimu_net(_run.gimu_thesis(), gps=_run.gps_default(), **line)
        net.trace("gimu", "R")
        go(net, SECONDS, steps)
        return net.take_received("pc"), net.take_samples("gimu").tolist(), net.take_edges().tolist()

    assert heard(1) == heard(STEPS)


def test_edges_arrive_a_bit_later_and_both_pins_can_be_seen() -> None:
    net = gimu_net()
    left, came = net.trace("gimu", "T"), net.trace("pc", "RXD")
    go(net, 1.0)
    edges = net.take_edges()
    t = edges[edges[:, 1] == left][:, [0, 2]]
    bit_ps = round(PS_PER_S / BAUD)
    assert t[0].tolist() == [80 * PS_PER_S // 1000, 0]
    assert (edges[edges[:, 1] == came][:, [0, 2]] == t + [bit_ps, 0]).all()


def test_nmea_comes_out_of_the_other_pin() -> None:
    net = gimu_net(gps=_run.gps_ideal())
    net.host("nmea", 4800)
    net.line("gimu.R", "nmea", 4800)
    go(net, 1.0)
    gga, rmc = net.take_octets("nmea").split()
    assert gga.startswith(b"$GPGGA,000000.000,2445.4200,N,12057.0600,E,1,08,1.2,60.0,M,")
    assert rmc.startswith(b"$GPRMC,000000.000,A,2445.4200,N,12057.0600,E,0.00,")


def test_a_motion_outlives_its_name() -> None:
    motion = _run.motion_rate([0.1, 0.0, 0.0], 0.0)
    track = _run.track_still(site(), motion)
    net = gimu_net(track=track)
    del motion, track
    go(net, 1.0)
    assert net.take_samples("gimu")[0, 2] == NULL + round(0.1 / LSB_RATE)


def test_a_baud_that_is_off_is_heard() -> None:
    net = gimu_net()
    fault = _run.Fault("baud")
    fault.value = -60_000.0
    fault.from_ps, fault.to_ps = PS_PER_S, 2 * PS_PER_S
    net.add_fault("gimu", fault)
    go(net, 4.0)
    bad = [at / PS_PER_S for at, _, framing_ok in net.take_received("pc") if not framing_ok]
    assert bad and min(bad) > 1.0 and max(bad) < 2.0
    assert net.fault_hits("gimu") == [("baud", 1)]
    with pytest.raises(ValueError, match="kind: a GIMU has a baud that may be off"):
        net.add_fault("gimu", _run.Fault("crystal"))


def test_tracks_in_numbers() -> None:
    line = _run.track_line(site(gravity="normal", rotating=True), math.pi / 2, 0.0, (10.0, 0.0, 2.0, 8.0, 2.0))
    end = line.at(100.0)
    assert end["p_n"] == pytest.approx([0.0, 100.0, 0.0], abs=1e-9)
    assert end["llh"][1] - math.radians(120.951) == pytest.approx(
        100.0 / EARTH_RADIUS_M / math.cos(math.radians(24.757)), rel=0.01
    )
    assert -end["f_b"][2] == pytest.approx(9.789, abs=1e-3)
    eight = _run.track_eight(site(), 0.0, 100.0, 40.0, SPEED)
    assert max(abs(eight.at(t)["p_n"][0]) for t in np.arange(0, 60, 0.1)) == pytest.approx(50.0, abs=0.1)
    t, north, east = [0.0, 10.0, 20.0, 30.0], [0.0, 50.0, 90.0, 100.0], [0.0, 10.0, 50.0, 100.0]
    way = _run.track_waypoints(site(), t, north, east, [0.0, 1.0, 2.0, 2.0])
    assert way.at(20.0)["p_n"] == pytest.approx([90.0, 50.0, -2.0])


def test_what_is_wrong_is_named() -> None:
    with pytest.raises(ValueError, match="gravity: found 'moon', but thesis or normal is needed"):
        site(gravity="moon")
    with pytest.raises(ValueError, match=r"\|radius\| is 0"):
        _run.track_circle(site(), 0.0, 0.0, SPEED)
    with pytest.raises(ValueError, match="speed: accelerate_s is 0"):
        _run.track_line(site(), 0.0, 0.0, (1.0, 0.0, 0.0, 1.0, 1.0))
    with pytest.raises(ValueError, match="t, north, east and up must have the same length"):
        _run.track_waypoints(site(), [0.0], [], [], [])
    config = _run.gimu_ideal()
    with pytest.raises(ValueError, match="order: found 'height'"):
        config.order = "height"
    with pytest.raises(ValueError, match="channel: found 'colour'"):
        config.set("colour", [0.0] * 6)
    config.set("null_v", [1.6, 1.6, 99.0, 1.6, 1.6, 1.6])
    with pytest.raises(ValueError, match="gimu: GIMU: R: null_v is 99"):
        gimu_net(config)
    gps = _run.gps_ideal()
    gps.sats = 2
    with pytest.raises(ValueError, match="gimu: gps: sats is 2"):
        gimu_net(gps=gps)
