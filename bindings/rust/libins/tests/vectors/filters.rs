//! kalman_pva.json, gps_dr.json.
//! SPDX-License-Identifier: MIT
use crate::json::Json;
use crate::{load, real, tol, wide, Worst};
use libins::dead_reckoning::{self, DrEkf};
use libins::fusion::{self, Fusion, Mode, Switch, SwitchConfig};
use libins::gps_axis::{self, GpsAxis};
use libins::kalman::{Innovation, Kalman, Ud};
use libins::pva::{Pva, What};
use libins::unicycle::{self, Unicycle};
use libins::{Error, Real};
use std::f64::consts::PI;

const TOL_PVA: f64 = tol(1e-12, 3e-5); // of an element over the largest of its kind in that step
const TOL_STEADY: f64 = tol(1e-9, 1e-5);
const TOL_STEADY_POS_VEL: f64 = 1e-5; // still converging at the end of the run: 2.4e-6
const TOL_MODEL: f64 = tol(1e-10, 2e-6); // Phi; the file's is Van Loan's, good to 1e-11
const TOL_RUN: f64 = tol(1e-11, 2e-3); // of an element over 1 or its own size
const TOL_STEP: f64 = tol(1e-12, 2e-5);

fn number(x: &Json) -> Real {
    x.number() as Real
}

fn matrix<const N: usize>(x: &Json) -> [[Real; N]; N] {
    let rows: Vec<[f64; N]> = x.arrays();
    std::array::from_fn(|i| real(rows[i]))
}

fn diagonal<const N: usize>(p: &[f64]) -> [f64; N] {
    assert_eq!(p.len(), N * N);
    std::array::from_fn(|i| p[(N + 1) * i])
}

fn flat<const N: usize>(p: &[[Real; N]; N]) -> Vec<f64> {
    p.iter().flat_map(wide).collect()
}

/// Against the largest of the wanted.
fn take_matrix(worst: &mut Worst, got: &[f64], want: &Json, place: &str) {
    let want = want.flat();
    let scale = want.iter().fold(1e-3_f64, |m, v| m.max(v.abs()));
    worst.take_all(got, &want, scale, place);
}

/// Each against its own size, or 1.
fn take_elements(worst: &mut Worst, got: &[f64], want: &Json, place: &str) {
    let want = want.flat();
    assert_eq!(got.len(), want.len(), "{place}");
    for (g, w) in got.iter().zip(want) {
        worst.take(*g, w, w.abs().max(1.0), place);
    }
}

/// The two generic filters and that of the module, as one.
enum Filter {
    Joseph(Kalman<3>),
    Factored(Box<Ud<3, 6>>),
    Module(Pva),
}

impl Filter {
    fn x(&self) -> [f64; 3] {
        match self {
            Filter::Joseph(f) => wide(&f.x),
            Filter::Factored(f) => wide(&f.x),
            Filter::Module(f) => wide(f.x()),
        }
    }
    fn p(&self) -> Vec<f64> {
        match self {
            Filter::Joseph(f) => flat(&f.p),
            Filter::Factored(f) => flat(&f.covariance()),
            Filter::Module(f) => wide(f.p()).to_vec(),
        }
    }
    fn gain(&self) -> [f64; 3] {
        match self {
            Filter::Joseph(f) => wide(f.gain()),
            Filter::Factored(f) => wide(f.gain()),
            Filter::Module(f) => wide(f.gain()),
        }
    }
    fn predict(&mut self, file: &Json) {
        let (phi, q) = (matrix(&file["A"]), matrix(&file["Q"]));
        match self {
            Filter::Joseph(f) => f.predict(&phi, &q),
            Filter::Factored(f) => f.predict(&phi, &Ud::<3, 6>::factor(&q).unwrap()),
            Filter::Module(f) => f.predict(number(&file["T"]), number(&file["q"])).unwrap(),
        }
    }
    fn update(&mut self, row: usize, z: &Json, r: &Json) {
        let innovation = |x: Real| Innovation { v: number(z) - x, r: number(r), gate: 0.0 };
        let mut h = [0.0; 3];
        h[row] = 1.0;
        match self {
            Filter::Joseph(f) => f.update(&h, &innovation(f.x[row])),
            Filter::Factored(f) => f.update(&h, &innovation(f.x[row])),
            Filter::Module(f) => f.update([What::Position, What::Velocity][row], &innovation(f.x()[row])),
        }
        .unwrap();
    }
}

/// One of the file's runs; updates are skipped in the outage.
fn run_pva(mut f: Filter, file: &Json, run: &Json, steps: &Json, outage: std::ops::Range<usize>) {
    let name = run["name"].text();
    let (mut state, mut covariance, mut gain) = (Worst::default(), Worst::default(), Worst::default());
    let rows = run["H"].list().len();
    let mut next = steps.list().iter().peekable();
    for (k, z) in run["z"].list().iter().enumerate() {
        f.predict(file);
        if !outage.contains(&k) {
            for row in 0..rows {
                f.update(row, &z[row], &run["R"][row][row]);
            }
        }
        let Some(step) = next.next_if(|step| step["k"].integer() == k) else { continue };
        let place = format!("{name} step {k}");
        take_matrix(&mut state, &f.x(), &step["x"], &place);
        take_matrix(&mut covariance, &diagonal::<3>(&f.p()), &step["P_diag"], &place);
        if let Some(p) = step.find("P").filter(|p| **p != Json::Null) {
            take_matrix(&mut covariance, &f.p(), p, &place);
        }
        if let Some(k_want) = step.find("K").filter(|g| rows == 1 && **g != Json::Null && !outage.contains(&k)) {
            take_matrix(&mut gain, &f.gain(), k_want, &place);
        }
    }
    assert!(next.next().is_none(), "{name}: steps were not reached");
    state.within(TOL_PVA, &format!("{name} x"));
    covariance.within(TOL_PVA, &format!("{name} P"));
    if rows == 1 {
        gain.within(TOL_PVA, &format!("{name} K"));
    }
    if outage.is_empty() {
        let mut steady = Worst::default();
        take_matrix(&mut steady, &f.p(), &run["steady"]["P_plus"], name);
        steady.within(if rows == 1 { TOL_STEADY } else { TOL_STEADY_POS_VEL }, &format!("{name} steady P"));
    }
}

#[test]
fn kalman_pva() {
    let file = load("kalman_pva.json");
    for run in file["runs"].list() {
        let (x, p) = (real(run["x0"].array()), matrix(&run["P0"]));
        let var = real(diagonal(&run["P0"].flat()));
        let filters = || {
            [
                Filter::Joseph(Kalman::new(x, p)),
                Filter::Factored(Box::new(Ud::new(x, &p).unwrap())),
                Filter::Module(Pva::new(&var).unwrap()),
            ]
        };
        for f in filters() {
            run_pva(f, &file, run, &run["steps"], 0..0);
        }
        for f in filters() {
            run_pva(f, &file, run, &run["steps_outage_400_499"], 400..500);
        }
    }
}

#[test]
fn gps_axis() {
    let file = load("gps_dr.json");
    let g = &file["gps"];
    let config = gps_axis::Config {
        dt: number(&g["T"]),
        tau_acceleration: number(&g["tau_a"]),
        tau_fix: number(&g["tau_eps"]),
        sigma_acceleration: number(&g["sigma_a2"]).sqrt(),
        sigma_fix: number(&g["sigma_eps2"]).sqrt(),
        r: number(&g["R"]),
        gate: 0.0,
        acceleration_max: 0.0,
    };
    let mut f = GpsAxis::new(&config, &real(diagonal(&g["P0"].flat()))).unwrap();
    let (mut model, mut run, mut steady) = (Worst::default(), Worst::default(), Worst::default());
    take_elements(&mut model, &wide(f.phi()), &g["Phi"], "Phi");
    model.within(TOL_MODEL, "GPS axis model");
    let mut steps = g["steps"].list().iter().peekable();
    for (k, z) in g["z"].list().iter().enumerate() {
        f.step(number(&z[0])).unwrap();
        if let Some(step) = steps.next_if(|step| step["k"].integer() == k) {
            take_elements(&mut run, &wide(f.x()), &step["x"], &format!("x {k}"));
            take_elements(&mut run, &diagonal::<4>(&wide(f.p())), &step["P_diag"], &format!("P {k}"));
            take_elements(&mut run, &wide(f.gain()), &step["K"], &format!("K {k}"));
        }
    }
    assert!(steps.next().is_none());
    run.within(TOL_RUN, "GPS axis run");
    for _ in 0..2000 {
        f.step(0.0).unwrap();
    }
    take_elements(&mut steady, &wide(f.gain()), &g["steady"]["K"], "K");
    take_elements(&mut steady, &wide(f.p()), &g["steady"]["P_plus"], "P");
    steady.within(tol(1e-7, 1e-3), "GPS axis steady state");
}

#[test]
fn dead_reckoning_sums() {
    let mut worst = Worst::default();
    for c in load("gps_dr.json")["dead_reckoning"].list() {
        let mut pose = real([c["e"].number(), c["n"].number(), c["heading"].number()]);
        dead_reckoning::step(&mut pose, number(&c["s"]), number(&c["dheading"])).unwrap();
        let (got, want): ([f64; 3], [f64; 3]) = (wide(&pose), c["out"].array());
        worst.take_all(&got[..2], &want[..2], 100.0, "east, north");
        let turn = got[2] - want[2];
        worst.take(turn - 2.0 * PI * (turn / (2.0 * PI)).round(), 0.0, 1.0, "heading");
    }
    worst.within(tol(1e-15, 1e-6), "dead reckoning");
}

#[test]
fn dr_ekf() {
    let file = load("gps_dr.json");
    let d = &file["dr"];
    let config = dead_reckoning::Config {
        dt: number(&d["T"]),
        tau: real([d["tau_e"].number(), d["tau_n"].number()]),
        sigma: real(d["sigma2"].array::<2>().map(f64::sqrt)),
        r_rate: number(&d["R"][0][0]),
        r_distance: number(&d["R"][1][1]),
        v_min: number(&d["vmin"]),
        v_zero: number(&d["vzero"]),
        gate: 0.0,
    };
    let mut f = DrEkf::new(&config, &real(d["x0"].array()), &real(diagonal(&d["P0"].flat()))).unwrap();
    let (mut run, mut both) = (Worst::default(), 0);
    let mut steps = d["steps"].list().iter().peekable();
    for (k, z) in d["z"].list().iter().enumerate() {
        f.step(number(&z[0]), number(&z[1])).unwrap();
        both += usize::from(f.used() == (true, true));
        if let Some(step) = steps.next_if(|step| step["k"].integer() == k + 1) {
            take_elements(&mut run, &wide(f.x()), &step["x"], &format!("x {k}"));
            take_elements(&mut run, &diagonal::<6>(&wide(f.p())), &step["P_diag"], &format!("P {k}"));
        }
    }
    assert!(steps.next().is_none());
    assert!(both > 200, "{both} steps with both measurements");
    assert_eq!(f.gated(), 0);
    run.within(TOL_RUN, "DR filter run");
}

#[test]
fn unicycle_run() {
    let file = load("gps_dr.json");
    let u = &file["dr_unicycle"];
    let config = unicycle::Config {
        q_speed: number(&u["qv"]),
        q_bias: number(&u["qb"]),
        q_scale: number(&u["qk"]),
        r_rate: number(&u["rw"]),
        r_distance: number(&u["rs"]),
        gate: 0.0,
        gate_gps: 0.0,
    };
    let period = number(&u["T"]);
    let mut f = Unicycle::new(&config, &real(u["x0"].array()), &real(diagonal(&u["P0"].flat()))).unwrap();
    let mut run = Worst::default();
    let mut steps = u["steps"].list().iter().peekable();
    for (k, z) in u["z"].list().iter().enumerate() {
        f.odometer(period, number(&z[1])).unwrap();
        f.predict(period, number(&z[0])).unwrap();
        if z[2] != Json::Null {
            f.gps(number(&z[2][0]), number(&z[2][1]), number(&u["Rgps"])).unwrap();
        }
        if let Some(step) = steps.next_if(|step| step["k"].integer() == k + 1) {
            let mut x = wide(f.x());
            let turn = x[2] - step["x"][2].number();
            x[2] -= 2.0 * PI * (turn / (2.0 * PI)).round();
            take_elements(&mut run, &x, &step["x"], &format!("x {k}"));
            take_elements(&mut run, &diagonal::<6>(&wide(f.p())), &step["P_diag"], &format!("P {k}"));
        }
    }
    assert!(steps.next().is_none());
    run.within(TOL_RUN, "unicycle run");
}

#[test]
fn fusion_and_sharing() {
    let mut worst = Worst::default();
    for c in load("gps_dr.json")["fusion"].list() {
        let mut fused = Fusion::<4>::default();
        assert_eq!(fused.solve(), Err(Error::Range), "nothing is known");
        for (x, p) in c["x"].list().iter().zip(c["P"].list()) {
            fused.add(&real(x.array()), &matrix(p)).unwrap();
        }
        let (x, p) = fused.solve().unwrap();
        take_elements(&mut worst, &wide(&x), &c["x_fused"], "x");
        take_elements(&mut worst, &flat(&p), &c["P_fused"], "P");
        for (beta, want) in c["beta"].list().iter().zip(c["P_local_reset"].list()) {
            take_elements(&mut worst, &flat(&fusion::share(&p, number(beta)).unwrap()), want, "P shared");
        }
        assert_eq!(fusion::share(&p, 1.5), Err(Error::Range));
    }
    worst.within(TOL_STEP, "fusion");
}

#[test]
fn switch_with_hysteresis() {
    let file = load("gps_dr.json");
    let s = &file["switch"];
    let config = SwitchConfig {
        hdop_max: number(&s["params"]["hmax"]),
        gate: number(&s["params"]["gate"]),
        sats: s["params"]["smin"].integer() as u8,
        back: s["params"]["n_back"].integer() as u8,
    };
    let mut switch = Switch::new(&config).unwrap();
    for (k, (e, want)) in s["epochs"].list().iter().zip(s["expected"].list()).enumerate() {
        let nis = if e["nis"] == Json::Null { 0.0 } else { number(&e["nis"]) };
        let mode = switch.epoch(e["valid"].bool(), e["sats"].integer() as u32, number(&e["hdop"]), nis);
        assert_eq!(mode, if want["mode"].text() == "GPS" { Mode::Gps } else { Mode::Dr }, "epoch {k}");
        assert_eq!(switch.good(), want["good"].bool(), "epoch {k}");
    }
    assert!(Switch::new(&SwitchConfig { back: 0, ..config }).is_err());
}
