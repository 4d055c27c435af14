//! gimu.json, handshake.json.
//! SPDX-License-Identifier: MIT
use crate::json::Json;
use crate::{load, real, tol, wide, Worst};
use libins::gimu::{self, Packet, Parser};
use libins::handshake::{block_codes, block_put, Board, Config, Event, Host};
use libins::Real;

fn unhex(text: &str) -> Vec<u8> {
    (0..text.len()).step_by(2).map(|i| u8::from_str_radix(&text[i..i + 2], 16).unwrap()).collect()
}

fn hex(octets: &[u8]) -> String {
    octets.iter().map(|o| format!("{o:02X}")).collect()
}

fn compare_packet(got: Packet, want: &Json, name: &str) {
    let near = |e7: i32, degrees: f64| assert!((f64::from(e7) - degrees * 1e7).abs() <= 0.51, "{name}: {e7} for {degrees}");
    let kind = want["type"].integer();
    let raw_of = |raw: [u16; 6]| assert_eq!(raw.map(f64::from).to_vec(), want["raw"].flat(), "{name}");
    match got {
        Packet::T1 { raw } => {
            assert_eq!(kind, 1, "{name}");
            raw_of(raw);
        }
        Packet::T2 { raw, coordinate, position, sats } => {
            assert_eq!(kind, 2, "{name}");
            raw_of(raw);
            assert_eq!(coordinate.map(|c| c as usize), [want["lat_raw"].integer(), want["lon_raw"].integer()], "{name}");
            assert_eq!(usize::from(sats), want["sats"].integer(), "{name}");
            let (f1, f2) = (want["f1_deg"].number(), want["f2_deg"].number());
            let (lat, lon) = position.expect(name);
            near(lat, if f1 > 90.0 { f2 } else { f1 });
            near(lon, if f1 > 90.0 { f1 } else { f2 });
        }
    }
}

#[test]
fn gimu_streams_and_coordinates() {
    let file = load("gimu.json");
    for s in file["streams"].list() {
        let name = s["name"].text();
        let mut parser = Parser::new(s["strict12"].bool());
        let mut packets: Vec<Packet> = unhex(s["hex"].text()).into_iter().filter_map(|octet| parser.rx(octet)).collect();
        packets.extend(std::iter::from_fn(|| parser.flush()));
        assert_eq!(packets.len(), s["packets"].list().len(), "{name}");
        for (got, want) in packets.into_iter().zip(s["packets"].list()) {
            compare_packet(got, want, name);
        }
        // The reference leaves the last 13 octets unread; the machine drops those of them that begin nothing.
        let dropped = parser.skipped() as usize - s["skipped"].integer();
        assert_eq!(s["hex"].text().len() / 2 - parser.waiting(), s["rest_offset"].integer() + dropped, "{name}");
    }
    for c in file["latlon"].list() {
        let e7 = gimu::e7(c["raw"].integer() as u32).unwrap();
        assert!((f64::from(e7) - c["decimal_deg"].number() * 1e7).abs() <= 0.51, "{c:?}");
    }
    assert_eq!(gimu::e7(181_000_000), None);
    assert_eq!(gimu::e7(600_000), None);
}

#[test]
fn gimu_scaling() {
    let file = load("gimu.json");
    let mut worst = Worst::default();
    for c in file["conversions"].list() {
        let raw = [c["raw"].integer() as u16; 6];
        let null = [c["null"].number() as Real; 6];
        let thesis = gimu::Scale { null, ..gimu::scale_thesis() };
        let nominal = gimu::Scale { null, ..gimu::scale_nominal() };
        let (dtheta, dv) = gimu::increments(&thesis, &raw, 1.0);
        for (i, name) in ["dps_KP", "dps_KQ", "dps_KR"].iter().enumerate() {
            worst.take(wide(&dtheta)[i].to_degrees(), c[*name].number(), 500.0, name);
            worst.take(wide(&dv)[i] / 9.8, c["g_datasheet"].number(), 2.0, "g");
        }
        let (dtheta, _) = gimu::increments(&thesis, &raw, 1.0 / gimu::RATE_HZ as Real);
        worst.take(wide(&dtheta)[0].to_degrees(), c["dtheta_deg_KP"].number(), 100.0, "dtheta");
        let (dtheta, _) = gimu::increments(&nominal, &raw, 1.0);
        worst.take(wide(&dtheta)[2].to_degrees(), c["dps_datasheet"].number(), 500.0, "data sheet");
    }
    worst.within(tol(1e-15, 3e-7), "GIMU scaling");
    let drift = &file["static_drift"];
    let degrees = wide(&real(gimu::scale_thesis().rate.map(f64::from)))[0].to_degrees() * 60.0 * drift["d"].number();
    assert!((degrees - drift["angle_deg_60s"].number()).abs() < 1e-5, "{degrees}");
}

#[test]
fn handshake_transcripts() {
    for c in load("handshake.json")["cases"].list() {
        // A block is sent three times in the file.
        let config = Config { block_len: 6, seq: false, retries: 2, reply_timeout: 100, octet_timeout: 20 };
        let (mut board, mut host) = (Board::new(&config).unwrap(), Host::new(&config).unwrap());
        let codes = c["xyz"].array::<3>().map(|x| x as u16);
        let block = block_put(&codes);
        assert_eq!(block_codes(&block), codes);
        board.offer(&block, 0, 0).unwrap();
        let (mut transcript, mut accepted, mut frame, mut frames) = (Vec::new(), Json::Null, Vec::new(), 0);
        while let Some(octet) = board.tx(0) {
            frame.push(octet);
            if frame.len() != if transcript.is_empty() { 1 } else { 7 } {
                continue;
            }
            if let Some(fault) = c["faults"].list().get(frames).filter(|_| frame.len() == 7) {
                let at = fault[1].integer();
                match fault[0].text() {
                    "bit" => frame[at] ^= 1 << fault[2].integer(),
                    "swap" => frame.swap(at, at + 1),
                    other => panic!("fault {other}"),
                }
            }
            frames += usize::from(frame.len() == 7);
            transcript.push(("A>B", hex(&frame)));
            for octet in std::mem::take(&mut frame) {
                let (event, reply) = host.rx(octet, 0);
                if event == Event::Block {
                    accepted = Json::List(host.block().iter().map(|o| Json::Number(f64::from(*o))).collect());
                }
                if let Some(reply) = reply {
                    transcript.push(("B>A", hex(&[reply])));
                    board.rx(reply, 0);
                }
            }
        }
        let want: Vec<_> = c["transcript"].list().iter().map(|line| (line[0].text(), line[1].text().to_string())).collect();
        assert_eq!(transcript, want, "{c:?}");
        assert_eq!(accepted, c["accepted"], "{c:?}");
        let sum = block.iter().fold(0u8, |s, o| s.wrapping_add(*o));
        assert_eq!(usize::from(sum), c["checksum"].integer());
        let taken = accepted != Json::Null;
        assert!(!board.busy());
        assert_eq!((board.counters().sent == 1, board.counters().given_up == 1), (taken, !taken));
        assert_eq!(host.counters().accepted == 1, taken);
        let right = Json::List(block.iter().map(|o| Json::Number(f64::from(*o))).collect());
        assert_eq!(taken && accepted != right, c["undetected"].bool());
    }
}
