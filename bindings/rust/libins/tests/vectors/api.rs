//! What the reference files do not reach: each module once, refusals, and the boundary itself.
//! SPDX-License-Identifier: MIT
use crate::{real, tol, wide};
use libins::align::{self, Mean};
use libins::attitude::Attitude;
use libins::batch::{Batch, ROWS};
use libins::coning::{self, Form};
use libins::hist2::Hist2;
use libins::kalman::{Innovation, Kalman, Ud, GATE_99};
use libins::nmea::{Parser, Sentence};
use libins::q31::{Q31w, ONE, Q31};
use libins::rates::{Rates, Skew};
use libins::sculling::Increment;
use libins::strapdown::{difference, Position, Strapdown};
use libins::{earth, geodesy, gps_axis, handshake, link, markov, quat, selftest, sixacc, tm, version};
use libins::{Error, Order, Quat, Real, Vec3};

const LEVEL: Quat = [1.0, 0.0, 0.0, 0.0];

fn angle(a: &Quat, b: &Quat) -> f64 {
    let d = wide(&quat::mul(a, &quat::conj(b)));
    2.0 * (d[1] * d[1] + d[2] * d[2] + d[3] * d[3]).sqrt().atan2(d[0].abs())
}

/// Increment k of a slow wobble.
fn wobble(k: usize) -> Vec3 {
    let t = 0.05 * k as f64;
    real([0.01 * t.sin(), 0.012 * (1.7 * t).cos(), -0.008 * (0.6 * t).sin()])
}

#[test]
fn version_and_selftest() {
    assert_eq!(version::check(), Ok(()));
    let text: Vec<i32> = env!("CARGO_PKG_VERSION").split('.').map(|part| part.parse().unwrap()).collect();
    assert_eq!(version::version(), 10000 * text[0] + 100 * text[1] + text[2], "the crates have the version of the core");
    assert_eq!(selftest::selftest(), Ok(()));
}

#[test]
fn errors_carry_the_core_s_text() {
    assert_eq!(Error::Range.to_string(), "an argument is out of range or not a number");
    assert_eq!(Error::Gate.to_string(), "measurement refused: its innovation is outside the gate");
    assert!(Error::Length.to_string().contains("length"));
    let boxed: Box<dyn std::error::Error> = Box::new(Error::State);
    assert!(boxed.to_string().contains("not in this state"));
}

#[test]
fn refused_means_unchanged() {
    let mut attitude = Attitude::new(Form::Hist2Opt, &LEVEL).unwrap();
    attitude.step(&[0.1, 0.2, 0.3]).unwrap();
    let before = format!("{attitude:?}");
    assert_eq!(attitude.step(&[Real::NAN, 0.0, 0.0]), Err(Error::Range));
    assert_eq!(attitude.turn_frame(&[Real::INFINITY, 0.0, 0.0]), Err(Error::Range));
    assert_eq!(before, format!("{attitude:?}"));
    assert_eq!(Attitude::new(Form::Block3Opt, &LEVEL).unwrap_err(), Error::Range);
    assert_eq!(Attitude::new(Form::One, &[2.0, 0.0, 0.0, 0.0]).unwrap_err(), Error::Range);
    attitude.jump(&[0.0, 0.0, 1.0]).unwrap();
    assert_eq!(attitude.step(&[0.0; 3]), Ok(Order::StartUp), "a jump restarts the history");
}

#[test]
fn slices_of_another_length_are_refused() {
    assert_eq!(coning::phi(Form::Block3Opt, &[[0.0; 3]; 2]), Err(Error::Length));
    assert_eq!(libins::fiter::turn(libins::fiter::Form::Hist3, &[[0.0; 3]; 5]), Err(Error::Length));
    assert_eq!(libins::sculling::dv(Form::Hist1, &[Increment::default()]), Err(Error::Length));
    let mut state = [0.0; ROWS * 2];
    assert_eq!(Batch::new(&mut state, &[1.0; 7]).unwrap_err(), Error::Length);
    assert_eq!(Batch::new(&mut state, &[1.0; 4]).unwrap_err(), Error::Length);
    let mut batch = Batch::new(&mut state, &[1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).unwrap();
    assert_eq!(batch.step(&[0.0; 5]), Err(Error::Length));
    let six = sixacc::SixAcc::new(&sixacc::paper(0.1), 0.01).unwrap();
    assert_eq!(six.resolve(&[0.0; 5], &[0.0; 3]), Err(Error::Length));
    assert_eq!(sixacc::SixAcc::new(&sixacc::paper(0.1)[..5], 0.01).unwrap_err(), Error::Range);
    let config = handshake::Config { block_len: 6, seq: false, retries: 2, reply_timeout: 100, octet_timeout: 20 };
    assert_eq!(handshake::Board::new(&config).unwrap().offer(&[0; 5], 0, 0), Err(Error::Length));
    assert_eq!(link::Board::new(&config).unwrap().offer(&[0; 7], 0, 0), Err(Error::Length));
}

#[test]
fn batch_has_the_bits_of_the_single_step() {
    const N: usize = 3;
    let mut state = [0.0; ROWS * N];
    let q0: Vec<Real> = (0..4 * N).map(|i| LEVEL[i / N]).collect();
    let mut batch = Batch::new(&mut state, &q0).unwrap();
    let mut single = [Attitude::new(Form::Hist2Opt, &LEVEL).unwrap(); N];
    for k in 0..200 {
        let increments: [Vec3; N] = std::array::from_fn(|i| wobble(k + 37 * i));
        let rows: Vec<Real> = (0..3 * N).map(|j| increments[j % N][j / N]).collect();
        let order = batch.step(&rows).unwrap();
        for (one, increment) in single.iter_mut().zip(&increments) {
            assert_eq!(one.step(increment), Ok(order));
        }
    }
    for (i, one) in single.iter().enumerate() {
        let q: Quat = std::array::from_fn(|row| batch.q_nb()[row * N + i]);
        assert_eq!(q, *one.q_nb());
    }
}

#[test]
fn the_small_step_has_the_bits_of_the_general_one() {
    let mut lean = Hist2::new(&LEVEL).unwrap();
    let mut attitude = Attitude::new(Form::Hist2Opt, &LEVEL).unwrap();
    for k in 0..1000 {
        assert_eq!(lean.step(&wobble(k)), attitude.step(&wobble(k)));
        assert_eq!(lean.q_nb(), attitude.q_nb());
    }
    assert_eq!(lean.step(&[0.6, 0.0, 0.0]), Err(Error::Range));
    assert_eq!(lean.q_nb(), attitude.q_nb());
    assert!(Hist2::new(&[1.01, 0.0, 0.0, 0.0]).is_err());
}

#[test]
fn fixed_point_follows_the_float() {
    let mut narrow = Q31::new(&[ONE, 0, 0, 0]).unwrap();
    let mut wide_state = Q31w::new(&[ONE, 0, 0, 0]).unwrap();
    let mut attitude = Attitude::new(Form::Hist2Opt, &LEVEL).unwrap();
    for k in 0..1000 {
        let fixed = wide(&wobble(k)).map(|x| (x * f64::from(1u32 << 31)) as i32);
        assert_eq!(narrow.step(&fixed), wide_state.step(&fixed));
        attitude.step(&fixed.map(|x| (f64::from(x) / f64::from(1u32 << 31)) as Real)).unwrap();
    }
    let float = |q: &[i32; 4]| real(q.map(|x| f64::from(x) / f64::from(ONE)));
    assert!(angle(&float(narrow.q_nb()), attitude.q_nb()) < tol(1e-7, 3e-6));
    assert!(angle(&float(&wide_state.q_nb()), attitude.q_nb()) < tol(1e-8, 3e-6));
    assert_eq!(narrow.step(&[i32::MAX, 0, 0]), Err(Error::Range));
}

#[test]
fn rates_bridge_and_skew() {
    let mut rates = Rates::new(4, 0.02).unwrap();
    assert_eq!(rates.add(&[1.0, 0.0, 0.0]).unwrap(), ([0.0; 3], Order::StartUp));
    let (gap, _) = rates.bridge(4, &[1.0, 0.0, 0.0]).unwrap();
    assert!((wide(&gap)[0] - 0.1).abs() < 1e-7, "five periods of 1 rad/s");
    assert!(Rates::new(6, 0.02).is_err());
    let mut skew = Skew::new(1, &[0.0, 0.005, 0.01], 0.02).unwrap();
    for restart in [false, true] {
        if restart {
            skew.restart();
        }
        for k in 0..5 {
            // A ramp read late is ahead: interpolation takes it back to the scan's instant.
            let ramp = |delay: f64| 0.02 * f64::from(k) + delay;
            let (out, order) = skew.add(&real([ramp(0.0), ramp(0.005), ramp(0.01)])).unwrap();
            assert_eq!(order == Order::StartUp, k == 0);
            if k > 0 {
                wide(&out).iter().for_each(|x| assert!((x - ramp(0.0)).abs() < 1e-7, "{k}: {x}"));
            }
        }
    }
}

#[test]
fn strapdown_at_rest_stays_and_a_lever_arm_moves() {
    let lat: f64 = 0.4;
    let start = Position { anchor: real([lat, 2.1, 100.0]), offset: [0.0; 3] };
    let period = 0.01;
    let mut s = Strapdown::new(Form::Hist2Opt, period, &LEVEL, &[0.0; 3], &start).unwrap();
    let rate = earth::rate(lat.sin() as Real, lat.cos() as Real);
    let g = earth::gravity(lat.sin() as Real, 100.0);
    let rest = Increment { theta_b: rate.map(|w| w * period), v_b: [0.0, 0.0, -g * period] };
    for _ in 0..1000 {
        s.step(&rest).unwrap();
    }
    let moved = wide(&difference(&start, s.position()));
    assert!(moved.iter().all(|x| x.abs() < tol(1e-6, 2e-2)), "{moved:?} m in 10 s");
    assert!(wide(s.v_n()).iter().all(|v| v.abs() < tol(1e-6, 5e-3)), "{:?}", s.v_n());
    assert!(angle(s.q_nb(), &LEVEL) < tol(1e-9, 1e-5));
    let (v, place) = s.point(&[1.0, 0.0, 0.0], &[0.0, 0.0, 2.0]);
    let arm = wide(&difference(s.position(), &place));
    assert!((arm[0] - 1.0).abs() < tol(1e-6, 1e-4) && arm[1].abs() < 1e-2, "{arm:?} m");
    assert!((wide(&v)[1] - 2.0).abs() < 1e-2, "{v:?} m/s");
    assert!(Strapdown::new(Form::Hist2Opt, 0.0, &LEVEL, &[0.0; 3], &start).is_err());
}

#[test]
fn alignment() {
    let mut mean = Mean::new(1.0).unwrap();
    assert_eq!(mean.get(), Err(Error::State));
    for k in 0..100u32 {
        mean.add(&real([2047.0 + f64::from(k % 2), 10.0, 0.0])).unwrap();
    }
    let (value, error) = mean.get().unwrap();
    assert_eq!((mean.count(), wide(&value)), (100, [2047.5, 10.0, 0.0]));
    assert!((wide(&error)[1] - 1.0 / 12f64.sqrt()).abs() < 1e-6, "a still channel hides its null in a code: {error:?}");
    let q = quat::from_euler(&[0.2, -0.1, 1.0]);
    let body = |v: &Vec3| quat::rotate(&quat::conj(&q), v);
    let (down, field): (Vec3, Vec3) = ([0.0, 0.0, 1.0], [0.4, 0.0, 0.9]);
    let level = align::level(&body(&[0.0, 0.0, -9.8]), 1.0).unwrap();
    assert!(angle(&level, &q) < tol(1e-12, 1e-6));
    let triad = align::triad(&body(&down), &body(&field), &down, &field).unwrap();
    assert!(angle(&triad, &q) < tol(1e-12, 1e-6));
    assert_eq!(align::triad(&down, &down, &down, &field), Err(Error::Range));
}

#[test]
fn local_frames_and_projections() {
    let origin = real([0.4, 2.1, 50.0]);
    let local = geodesy::Local::new(geodesy::wgs84(), &origin).unwrap();
    let ned: Vec3 = [100.0, -20.0, 3.0];
    let back = wide(&local.from_ecef(&local.to_ecef(&ned)));
    assert!(back.iter().zip([100.0, -20.0, 3.0]).all(|(b, n)| (b - n).abs() < tol(1e-8, 1.0)), "{back:?}");
    assert_eq!(geodesy::swap(&ned), [-20.0, 100.0, -3.0]);
    assert_eq!(tm::twd97_zone((121.5f64.to_radians()) as Real), Some(121));
    assert_eq!(tm::twd97_zone(0.0), None);
    let tm = tm::Tm::new(geodesy::grs80(), 0.0, 1.0, [0.0, 0.0]).unwrap();
    let (en, convergence) = tm.forward(0.0, 0.0).unwrap();
    assert_eq!((en, convergence), ([0.0, 0.0], 0.0));
    let [meridian, normal] = earth::radii(0.0);
    assert!(meridian < normal);
    let turning = earth::transport_rate(0.0, 1.0, 0.0, &[0.0, 10.0, 0.0]);
    assert!((wide(&turning)[0] - 10.0 / wide(&[normal])[0]).abs() < 1e-12);
}

#[test]
fn gates_and_gauss_markov() {
    let mut joseph = Kalman::new([0.0, 0.0], [[1.0, 0.0], [0.0, 1.0]]);
    let mut ud = Ud::<2, 3>::new([0.0, 0.0], &[[1.0, 0.0], [0.0, 1.0]]).unwrap();
    let far = Innovation { v: 10.0, r: 1.0, gate: GATE_99 };
    assert_eq!((joseph.update(&[1.0, 0.0], &far), ud.update(&[1.0, 0.0], &far)), (Err(Error::Gate), Err(Error::Gate)));
    assert_eq!((joseph.nis(), ud.nis()), (50.0, 50.0));
    assert_eq!((joseph.x, ud.x), ([0.0; 2], [0.0; 2]));
    let phi = [[1.0, 1.0], [0.0, 1.0]];
    joseph.predict_covariance(&phi, &[[0.0; 2]; 2]);
    ud.predict_covariance(&phi, &[0.0; 3]);
    assert_eq!((joseph.p, joseph.x), ([[2.0, 1.0], [1.0, 1.0]], [0.0; 2]));
    assert_eq!(ud.covariance(), joseph.p);
    assert_eq!(Ud::<2, 3>::new([0.0; 2], &[[-1.0, 0.0], [0.0, 1.0]]).unwrap_err(), Error::Range);
    let (sigma, tau) = markov::STRAPDOWN;
    let m = markov::markov(tau, tau, sigma).unwrap();
    assert!((wide(&[m.phi])[0] - (-1f64).exp()).abs() < tol(1e-15, 1e-7));
    let config = gps_axis::Config { dt: 1.0, tau_acceleration: 20.0, tau_fix: 20.0, ..Default::default() };
    assert_eq!(gps_axis::GpsAxis::new(&config, &[1.0; 4]).unwrap_err(), Error::Range);
}

#[test]
fn extended_link_delivers_and_falls_back() {
    let config = handshake::Config { block_len: 6, seq: false, retries: 2, reply_timeout: 100, octet_timeout: 20 };
    let (mut board, mut host) = (link::Board::new(&config).unwrap(), link::Host::new(&config).unwrap());
    board.offer(&[1, 2, 3, 4, 5, 6], 77, 0).unwrap();
    assert_eq!(board.offer(&[0; 6], 78, 0), Err(Error::State));
    let mut frame = Vec::new();
    while let Some(octet) = board.tx(0) {
        frame.push(octet);
        if let (_, Some(reply)) = host.rx(octet, 0) {
            board.rx(reply, 0);
        }
    }
    assert_eq!((host.block(), host.seq(), host.is_extended()), (&[1, 2, 3, 4, 5, 6][..], 77, true));
    assert_eq!((board.extended(), board.fallbacks(), board.busy()), (1, 0, false));
    let sum = frame[1..8].iter().fold(link::CRC_START, |crc, octet| link::crc(crc, *octet));
    assert_eq!(sum, u16::from(frame[8]) << 8 | u16::from(frame[9]));

    // A host that knows only the paper is silent on 55.
    let mut board = link::Board::new(&config).unwrap();
    let mut paper = handshake::Host::new(&config).unwrap();
    board.offer(&[9, 8, 7, 6, 5, 4], 1, 0).unwrap();
    for now in (0..1000).step_by(10) {
        board.tick(now);
        while let Some(octet) = board.tx(now) {
            if let (_, Some(reply)) = paper.rx(octet, now) {
                board.rx(reply, now);
            }
        }
    }
    assert_eq!(paper.block(), [9, 8, 7, 6, 5, 4]);
    assert_eq!((board.fallbacks(), board.counters().sent, paper.counters().stray), (1, 1, 1));
}

#[test]
fn nmea_sentences() {
    let mut parser = Parser::default();
    let mut fixes = Vec::new();
    let text = b"$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n$GPGGA,1*00\r\n$GPVTG,054.7,T,034.4,M,005.5,N,010.2,K*48\r\n";
    fixes.extend(text.iter().filter_map(|octet| parser.rx(*octet)));
    assert_eq!(fixes.len(), 2);
    let gga = &fixes[0];
    assert_eq!((gga.sentence, gga.valid, gga.quality), (Sentence::Gga, true, 1));
    assert_eq!(gga.time_ms, Some(((12 * 60 + 35) * 60 + 19) * 1000));
    assert_eq!(gga.position, Some((481_173_000, 115_166_667)));
    assert_eq!((gga.sats, gga.hdop_milli, gga.altitude_mm, gga.geoid_mm), (Some(8), Some(900), Some(545_400), Some(46_900)));
    assert_eq!((gga.date, gga.speed_milliknot), (None, None));
    assert_eq!((fixes[1].sentence, fixes[1].course_mdeg, fixes[1].speed_milliknot), (Sentence::Vtg, Some(54_700), Some(5_500)));
    let counters = parser.counters();
    assert_eq!((counters.taken, counters.bad_checksum), (2, 1));
}
