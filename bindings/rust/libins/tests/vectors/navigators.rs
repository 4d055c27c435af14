//! The navigation filters: their forms against each other, aids, refusals.
//! SPDX-License-Identifier: MIT
use libins::sculling::Increment;
use libins::{coning, gps_dr, gps_ins, gyro_free, kalman, kf15, sixacc, strapdown, Error, Order};

const PERIOD_NS: i64 = 10_000_000;

fn car() -> (gps_ins::Config, gps_ins::Start, gps_ins::Fix) {
    let home = strapdown::Position { anchor: [0.9, 0.2, 100.0], offset: [0.0; 3] };
    let start = gps_ins::Start {
        q_nb: [1.0, 0.0, 0.0, 0.0],
        v_n: [10.0, 0.0, 0.0],
        position: home,
        sigma: [0.01, 0.01, 0.1, 1.0, 1.0, 1.0, 10.0, 10.0, 10.0, 1e-4, 1e-4, 1e-4, 0.01, 0.01, 0.01],
        ..gps_ins::Start::default()
    };
    let fix = gps_ins::Fix { t_ns: 100 * PERIOD_NS, position: home, v_n: [10.0, 0.0, 0.0], sigma_p: [100.0; 3], sigma_v: [10.0; 3] };
    (gps_ins::config(), start, fix)
}

fn turning() -> Increment {
    Increment { theta_b: [0.0, 0.0, 2e-3], v_b: [0.0, 0.02, -0.0981] }
}

#[test]
fn the_forms_of_gps_ins_agree() {
    let (config, start, fix) = car();
    let scales = kf15::ScaleSensors { gyro_sigma: 0.0, accel_sigma: 0.0, gyro_tau: 1e4, accel_tau: 1e4 };
    let mut nav = gps_ins::GpsIns::new(&config, &start).unwrap();
    let mut ud = gps_ins::GpsInsUd::new(&config, &start).unwrap();
    let mut scaled = gps_ins::GpsInsScale::new(&config, &scales, &start).unwrap();
    for k in 1..=100 {
        nav.step(k * PERIOD_NS, 0.01, &turning()).unwrap();
        ud.step(k * PERIOD_NS, 0.01, &turning()).unwrap();
        scaled.step(k * PERIOD_NS, 0.01, &turning()).unwrap();
    }
    nav.gnss(&fix).unwrap();
    ud.gnss(&fix).unwrap();
    scaled.gnss(&fix).unwrap();
    let want = nav.state();
    for got in [ud.state(), scaled.state()] {
        for i in 0..15 {
            assert!((got.sigma[i] / want.sigma[i] - 1.0).abs() < 1e-3, "sigma {i}");
        }
        assert!((got.v_n[1] - want.v_n[1]).abs() < 1e-3);
    }
    assert_eq!((nav.count().fixes, ud.count().steps, nav.state().t_ns), (1, 100, 100 * PERIOD_NS));
    assert!(nav.check().nis_position >= 0.0);
    assert_eq!((*scaled.gyro(), *scaled.accel()), ([0.0; 3], [0.0; 3]));
}

#[test]
fn gps_ins_takes_aids_and_refuses() {
    let (config, start, fix) = car();
    let scales = kf15::ScaleSensors { gyro_sigma: 0.01, accel_sigma: 0.01, gyro_tau: 1e4, accel_tau: 1e4 };
    let mut nav = gps_ins::GpsInsScale::new(&config, &scales, &start).unwrap();
    for k in 1..=100 {
        nav.step(k * PERIOD_NS, 0.01, &turning()).unwrap();
    }
    assert_eq!(nav.step(50 * PERIOD_NS, 0.01, &turning()), Err(Error::Range), "backward");
    nav.odometer(10.0, 5.0).unwrap();
    nav.altitude(100.0, 50.0).unwrap();
    nav.yaw_rate(0.197, 1e-3).unwrap();
    assert!(nav.gyro()[2] > 0.0, "another gyro says less");
    assert_eq!(nav.zupt(), Err(Error::Gate), "it moves");
    assert_eq!(nav.zaru(&[0.0, 0.0, 0.2]), Err(Error::Gate), "it turns");
    let _ = nav.nhc();
    let late = gps_ins::Fix { t_ns: -PERIOD_NS, ..fix };
    assert_eq!(nav.gnss(&late), Err(Error::Range));
    let wide = gps_ins::Start { sigma: [1.0; 15], ..start };
    assert_eq!(gps_ins::GpsIns::new(&config, &wide).err(), Some(Error::Range));
    assert_eq!(gps_ins::GpsInsUd::new(&config, &wide).err(), Some(Error::Range));
}

#[test]
fn the_forms_of_kf15_agree() {
    let sensors = kf15::Sensors { arw: 1e-4, vrw: 1e-3, bg_sigma: 1e-4, bg_tau: 300.0, ba_sigma: 1e-2, ba_tau: 300.0 };
    let none = kf15::ScaleSensors { gyro_sigma: 0.0, accel_sigma: 0.0, gyro_tau: 1e4, accel_tau: 1e4 };
    let (_, start, _) = car();
    let mut place = strapdown::Strapdown::new(coning::Form::Hist2Opt, 0.01, &start.q_nb, &start.v_n, &start.position).unwrap();
    let mut model = kf15::Model::new(0.01, &sensors).unwrap();
    let mut p = kf15::Kf15::new(&start.sigma).unwrap();
    let mut ud = kf15::Kf15Ud::new(&start.sigma).unwrap();
    let mut scaled = kf15::Kf15Scale::new(&start.sigma, &none).unwrap();
    for _ in 0..100 {
        place.step(&turning()).unwrap();
        model.set(&place, &turning().v_b);
        p.propagate(&model);
        ud.propagate(&model);
        scaled.propagate(&model, &turning());
    }
    let mut h = [0.0; kf15::N];
    h[kf15::V] = 1.0;
    h[kf15::BG + 2] = 0.5;
    let z = kalman::Innovation { v: 1.0, r: 0.1, gate: 0.0 };
    p.update(&h, &z).unwrap();
    ud.update(&h, &z).unwrap();
    scaled.update(&h, &[0.0; kf15::SCALES], &z).unwrap();
    p.update_state(kf15::P, &z).unwrap();
    ud.update_state(kf15::P, &z).unwrap();
    h = [0.0; kf15::N];
    h[kf15::P] = 1.0;
    scaled.update(&h, &[0.0; kf15::SCALES], &z).unwrap();
    for (a, (b, c)) in p.p().iter().zip(ud.p().iter().zip(scaled.kf15().p())) {
        assert!((a - b).abs() < 1e-3 && (a - c).abs() < 1e-3);
    }
    assert!((p.gain()[kf15::P] - ud.gain()[kf15::P]).abs() < 1e-3);
    assert!((p.nis() - ud.nis()).abs() < 1e-3 && (p.nis() - scaled.kf15().nis()).abs() < 1e-3);
    assert_eq!((scaled.gain(), scaled.variances()), (&[0.0; kf15::SCALES], [0.0; kf15::SCALES]));
    assert_eq!(model.transition()[0], 1.0);
    assert_eq!(p.update_state(kf15::N, &z), Err(Error::Range));
    assert_eq!(ud.update_state(usize::MAX, &z), Err(Error::Range));
    assert_eq!(kf15::Model::new(0.0, &sensors).err(), Some(Error::Range));
}

#[test]
fn gyro_free_and_gps_dr_refuse() {
    let (_, start, _) = car();
    let config = gyro_free::Config { noise: 1e-3, bias: 1e-3, position: 1.0, ..gyro_free::Config::default() };
    let accels = sixacc::paper(0.1);
    let mut nav = gyro_free::GyroFree::new(&config, &accels, 0.01, &start.q_nb, &[0.0; 3], &start.position).unwrap();
    assert_eq!(nav.step(&[0.0; 5]), Err(Error::Length));
    assert_eq!(nav.step(&accels.map(|a| -9.81 * a.axis[2])), Ok(Order::StartUp));
    nav.position_fix(&start.position, &[1.0; 3], &[0.0; 3]).unwrap();
    nav.velocity(&[0.0; 3], &[1.0; 3]).unwrap();
    assert_eq!(nav.velocity(&[0.0; 3], &[0.0; 3]), Err(Error::Range));
    assert_eq!((nav.q_nb()[0], nav.v_n()[0], nav.w_ib_b()[0]), (1.0, 0.0, 0.0));
    assert_eq!(nav.position().anchor, start.position.anchor);
    assert_eq!(gyro_free::GyroFree::new(&config, &accels[..5], 0.01, &start.q_nb, &[0.0; 3], &start.position).err(), Some(Error::Range));
    let mut pair = gps_dr::GpsDr::new(&gps_dr::config()).unwrap();
    assert_eq!(pair.source(), gps_dr::Source::None);
    assert_eq!(pair.state().err(), Some(Error::State));
    assert_eq!(pair.step(0.0, 0.0, 0.0), Err(Error::Range));
    assert_eq!(pair.fix(&gps_dr::Fix { valid: 1, ..gps_dr::Fix::default() }), Err(Error::Range), "no sigma");
    assert_eq!(pair.nis(), 0.0);
}
