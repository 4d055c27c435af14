"""handshake and gimu, through Python; a line of the extended frame; NMEA."""

import numpy as np
import pytest
from reference import both, expect, load, tolerance

TOL_SCALING = (1e-15, 3e-7)
"""Of 500 deg/s, 100 deg and 2 g."""
REPLY_TIMEOUT, OCTET_TIMEOUT = 40, 10
FRAME = 7
"""The paper's block and its sum."""
HALF_E7 = 0.51


def faulty(frame, fault):
    octets = bytearray(frame)
    at = fault[1]
    if fault[0] == "bit":
        octets[at] ^= 1 << fault[2]
    else:
        assert fault[0] == "swap"
        octets[at], octets[at + 1] = octets[at + 1], octets[at]
    return bytes(octets)


@both
def test_handshake_transcripts(ins):
    config = {"block_len": 6, "retries": 2, "reply_timeout": REPLY_TIMEOUT, "octet_timeout": OCTET_TIMEOUT}
    for case in load("handshake.json")["cases"]:
        board, host = ins.HsBoard(**config), ins.HsHost(**config)
        block = ins.hs_block_put(case["xyz"]).tobytes()
        assert np.array_equal(ins.hs_block_codes(np.frombuffer(block, dtype=np.uint8)), case["xyz"])
        board.offer(block, 0, 0)
        assert board.busy
        transcript, accepted, faults = [], None, list(case["faults"])
        while sent := board.take(0):
            if len(sent) == FRAME and faults:
                sent = faulty(sent, faults.pop(0))
            transcript.append(["A>B", sent.hex().upper()])
            replies, blocks = host.rx(sent, 0)
            accepted = list(blocks[0][0]) if blocks else accepted
            if replies:
                transcript.append(["B>A", replies.hex().upper()])
                board.rx(replies, 0)
        assert transcript == case["transcript"]
        assert accepted == case["accepted"]
        assert not board.busy
        assert (board.sent, board.given_up) == ((0, 1) if accepted is None else (1, 0))
        assert case["undetected"] == (accepted is not None and accepted != list(block))


@both
def test_extended_frame_and_fall_back(ins):
    config = {"block_len": 6, "retries": 2, "reply_timeout": REPLY_TIMEOUT, "octet_timeout": OCTET_TIMEOUT}
    for host, extended in ((ins.LinkHost(**config), True), (ins.HsHost(**config), False)):
        board = ins.LinkBoard(**config)
        now, delivered, frames = 65500, [], []  # the clock wraps on the way
        for number in range(3):
            board.offer(bytes([0, number, 0, 0, 0, 0]), number, now)
            while board.busy:
                sent = board.take(now)
                frames.append(sent)
                replies, blocks = host.rx(sent, now)
                delivered += blocks
                board.rx(replies, now)
                now += 0 if replies else REPLY_TIMEOUT + 1
                board.tick(now)
        assert [block[1] for block, _, _ in delivered] == [0, 1, 2]
        assert (board.extended, board.fallbacks > 0) == ((3, False) if extended else (0, True))
        frame = max(frames, key=len)
        if extended:
            assert [seq for _, seq, _ in delivered] == [0, 1, 2]
            assert host.extended
            assert ins.link_crc(frame[:-2]) == int.from_bytes(frame[-2:], "big")
            assert ins.link_crc(frame) == 0
        else:
            assert len(frame) == FRAME


@both
def test_gimu_streams(ins):
    for stream in load("gimu.json")["streams"]:
        octets = bytes.fromhex(stream["hex"])
        gimu = ins.Gimu(stream["strict12"])
        packets = gimu.rx(octets) + gimu.flush()
        assert len(packets) == len(stream["packets"]), stream["name"]
        for got, want in zip(packets, stream["packets"], strict=True):
            assert got.type == want["type"], stream["name"]
            assert got.raw.tolist() == want["raw"], stream["name"]
            if got.type == ins.GIMU_T2:
                assert got.coordinate.tolist() == [want["lat_raw"], want["lon_raw"]]
                assert got.sats == want["sats"]
                lon, lat = sorted((want["f1_deg"], want["f2_deg"]), reverse=True)
                assert got.has_position
                expect([got.lat_e7, got.lon_e7], [lat * 1e7, lon * 1e7], HALF_E7, stream["name"])
        dropped = gimu.skipped - stream["skipped"]
        assert len(octets) - gimu.count == stream["rest_offset"] + dropped, stream["name"]
        assert dropped + gimu.count < ins.GIMU_T1_LEN


@both
def test_gimu_coordinates_and_scaling(ins):
    file = load("gimu.json")
    for c in file["latlon"]:
        expect(ins.gimu_e7(c["raw"]), c["decimal_deg"] * 1e7, HALF_E7, str(c))
    thesis, nominal = ins.GimuScale.thesis(), ins.GimuScale.nominal()
    limit = tolerance(ins, *TOL_SCALING)
    for c in file["conversions"]:
        thesis.null = nominal.null = np.full(6, c["null"], dtype=ins.real)
        raw = np.full((2, 6), c["raw"], dtype=np.uint16)
        dtheta, dv = thesis.increments(raw, 1.0)
        expect(
            np.degrees(dtheta[1].astype(np.float64)), [c["dps_KP"], c["dps_KQ"], c["dps_KR"]], limit, str(c), scale=500
        )
        expect(dv[1].astype(np.float64) / 9.8, np.full(3, c["g_datasheet"]), limit, str(c), scale=2)
        dtheta, _ = thesis.increments(raw)
        expect(np.degrees(float(dtheta[0, 0])), c["dtheta_deg_KP"], limit, str(c), scale=100)
        dtheta, _ = nominal.increments(raw, 1.0)
        expect(np.degrees(float(dtheta[0, 2])), c["dps_datasheet"], limit, str(c), scale=500)
    drift = file["static_drift"]
    rate = float(ins.GimuScale.thesis().rate[0])
    expect(np.degrees(rate) * 60 * drift["d"], drift["angle_deg_60s"], 1e-5, "static drift")


@both
def test_nmea(ins):
    body = b"GPGGA,092750.000,5321.6802,N,00630.3372,W,1,8,1.03,61.7,M,55.2,M,,"
    total = 0
    for octet in body:
        total ^= octet
    nmea = ins.Nmea()
    (fix,) = nmea.rx(b"$" + body + f"*{total:02X}\r\n".encode())
    assert fix.type == ins.NMEA_GGA
    assert fix.valid and fix.quality == 1 and fix.sats == 8
    assert fix.has & ins.NMEA_POSITION and not fix.has & ins.NMEA_SPEED
    assert (fix.lat_e7, fix.lon_e7) == (533613367, -65056200)
    assert (fix.time_ms, fix.altitude_mm, fix.hdop_milli) == (34070000, 61700, 1030)
    assert nmea.rx(b"$" + body + b"*00\r\n") == []
    assert (nmea.taken, nmea.bad_checksum) == (1, 1)


@both
def test_navigation_block(ins):
    nav = ins.NavBlock()
    nav.time_ms, nav.sats, nav.fix_age = 123456789, 8, 4
    nav.status = ins.NAV_BLOCK_ALIGNED | ins.NAV_BLOCK_POSITION
    nav.en_cm = np.array([24712345, 276543210], dtype=np.int32)
    nav.v_en = np.array([-1.5, 12.25], dtype=ins.real)
    nav.q_nb = np.array([0.5, -0.5, 0.5, -0.5], dtype=ins.real)
    octets = nav.put()
    assert octets[:12].hex() == "04080009075bcd1501791499"
    back = ins.NavBlock.get(octets)
    assert (back.time_ms, back.status, back.sats, back.fix_age) == (123456789, nav.status, 8, 4)
    assert back.en_cm.tolist() == [24712345, 276543210]
    assert back.v_en.tolist() == [-1.5, 12.25]
    assert back.q_nb.tolist() == [0.5, -0.5, 0.5, -0.5]
    nav.v_en = np.array([0.0, 9000.0], dtype=ins.real)
    for refused in (nav.put, lambda: ins.NavBlock.get(octets[:-1]), lambda: ins.NavBlock.get(b"\x10" + octets[1:])):
        with pytest.raises(ins.RangeError, match="NavBlock"):
            refused()
