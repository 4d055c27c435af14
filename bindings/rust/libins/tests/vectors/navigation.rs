//! sculling.json, sixacc.json, calib_linear.json, calib_full.json, geodesy.json.
//! SPDX-License-Identifier: MIT
use crate::json::Json;
use crate::{load, real, tol, wide, Worst};
use libins::accelfit::{AccelFit, Motion};
use libins::coning::Form;
use libins::sculling::{self, Increment};
use libins::sixacc::{self, LinFit, SixAcc};
use libins::tm::Tm;
use libins::{geodesy, quat, Error, Real};
use std::f64::consts::PI;

const TOL_DV_REL: f64 = tol(1e-12, 3e-7);
const TOL_SIXACC_REL: f64 = tol(1e-12, 1e-6); // of the largest reading, and of it over the arm
const TOL_MAP: f64 = tol(1e-12, 2e-6);
const TOL_CLEAN: f64 = tol(1e-10, 2e-5);
const TOL_NOISY: f64 = tol(1e-7, 2e-5);
const TOL_SD_REL: f64 = tol(1e-5, 1e-3);
const TOL_ECEF_M: f64 = tol(1e-8, 6.0);
const TOL_ANGLE_RAD: f64 = tol(1e-13, 5e-7);
const TOL_TM_M: f64 = tol(1e-6, 2.0);
const TOL_THESIS_INVERSE_RAD: f64 = tol(1e-4 / 6.4e6, 5e-7);
const TOL_CONVERGENCE_RAD: f64 = tol(5e-8, 3e-7); // the file's is a difference quotient
const RAD: f64 = PI / 180.0;

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn reals(x: &[f64]) -> Vec<Real> {
    x.iter().map(|v| *v as Real).collect()
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |m, v| v.abs().max(m))
}

#[test]
fn sculling_rows_and_mean() {
    let mut worst = Worst::default();
    for c in load("sculling.json")["cases"].list() {
        for (name, form) in [("rot", Form::One), ("hist1", Form::Hist1), ("hist2_opt", Form::Hist2Opt)] {
            let increment = |theta: &Json, v: &Json| Increment { theta_b: real(theta.array()), v_b: real(v.array()) };
            let mut all: Vec<Increment> = c["pre"].list().iter().map(|p| increment(&p[0], &p[1])).collect();
            let mut sum = 0.0;
            for row in c["rows"].list() {
                all.push(increment(&row["theta"], &row["v"]));
                let dv = wide(&sculling::dv(form, &all[all.len() - form.samples()..]).unwrap());
                worst.take_all(&dv, &row[name].flat(), norm(row[name].array()), name);
                sum += dv[0] - row["true"][0].number();
            }
            let mean = sum / (c["rows"].list().len() as f64 * c["h"].number());
            let want = c["mean_x_error_mps2"][name].number();
            assert!((mean - want).abs() <= tol(1e-12 + 1e-6 * want.abs(), 2e-7), "{name}: {mean} m/s^2, want {want}");
        }
    }
    worst.within(TOL_DV_REL, "sculling dv, relative");
}

#[test]
fn sixacc_rows() {
    let file = load("sixacc.json");
    let (mut angular, mut force, mut resolved) = (Worst::default(), Worst::default(), Worst::default());
    for c in file["cases"].list() {
        let rho = c["rho"].number();
        let gravity: [f64; 3] = c["G_nav"].array();
        let accels = sixacc::paper(rho as Real);
        for (j, accel) in accels.iter().enumerate() {
            let place = file["pos_unit"][j].array::<3>().map(|x| x * rho);
            force.take_all(&wide(&accel.axis), &file["axis"][j].flat(), 1.0, "axis");
            force.take_all(&wide(&accel.r), &place, 1.0, "r");
        }
        let six = SixAcc::new(&accels, 0.02).unwrap();
        for row in c["rows"].list() {
            let readings = row["f"].flat();
            let size = largest(&readings);
            let (wd, f) = six.resolve(&reals(&readings), &real(row["w"].array())).unwrap();
            angular.take_all(&wide(&wd), &row["wd"].flat(), size / rho, "wd");
            force.take_all(&wide(&f), &row["f_centre"].flat(), size, "f");
            // Gravity is added where the vertical is known: in n, after resolving.
            let mut a = wide(&quat::rotate(&real(row["q"].array()), &f));
            a.iter_mut().zip(gravity).for_each(|(x, g)| *x += g);
            resolved.take_all(&a, &row["a"].flat(), size, "a");
        }
    }
    angular.within(TOL_SIXACC_REL, "angular acceleration, relative");
    force.within(TOL_SIXACC_REL, "specific force, relative");
    resolved.within(TOL_SIXACC_REL, "acceleration in n, relative");
}

#[test]
fn calib_linear_maps() {
    let file = load("calib_linear.json");
    let mut worst = Worst::default();
    for c in file["cases"].list() {
        let mut fit = LinFit::new(3).unwrap();
        for (k, up) in file["attitudes"][c["group"].text()].list().iter().enumerate() {
            let f_b = up.array::<3>().map(|u| u * c["g"].number());
            let readings: Vec<f64> = (0..3).map(|j| c["P"][j][k].number() / c["T"].number()).collect();
            fit.add(&real(f_b), &reals(&readings)).unwrap();
            if k < 3 {
                assert_eq!(fit.solve(0), Err(Error::State), "four unknowns from {} attitudes", k + 1);
            }
        }
        for j in 0..3 {
            let map = wide(&fit.solve(j).unwrap());
            worst.take_all(&map[1..], &c["true_map"][j].flat(), 1.0, "axis");
            worst.take(map[0], c["true"]["bias"][j].number() * c["true"]["SF"][j].number(), 1.0, "bias");
        }
        assert_eq!(fit.solve(3), Err(Error::Range));
        assert_eq!(fit.residual2().len(), 3);
    }
    worst.within(TOL_MAP, "linear map");
}

#[test]
fn calib_full_by_least_squares() {
    const PASSES: usize = 20;
    let file = load("calib_full.json");
    let (mut readings, mut clean, mut noisy, mut deviations) = (Worst::default(), Worst::default(), Worst::default(), Worst::default());
    let motion = |m: &[f64; 9]| Motion {
        f_b: real([m[0], m[1], m[2]].map(|up| up * file["g"].number())),
        w_ib_b: real([m[3], m[4], m[5]]),
        wd_ib_b: real([m[6], m[7], m[8]]),
    };
    let motions: Vec<Motion> = file["meas"].arrays().iter().map(motion).collect();
    for a in file["acc"].list() {
        let start = |key: &str| {
            let axes = [real(a["u0"].array()), real(a["e1"].array()), real(a["e2"].array())];
            AccelFit::new(&axes[0], &axes[1], &axes[2], &real(a[key].array())).unwrap()
        };
        let pass = |fit: &mut AccelFit, key: &str| {
            motions.iter().zip(a[key].flat()).for_each(|(motion, y)| fit.add(motion, y as Real).unwrap());
        };
        let solved = |key: &str| {
            let mut fit = start("p0");
            assert_eq!(fit.step(), Err(Error::State), "nothing was measured");
            let settled = (0..PASSES).any(|_| {
                pass(&mut fit, key);
                fit.step().unwrap() < tol(1e-12, 1e-5) as Real
            });
            assert!(settled, "no end in {PASSES} passes");
            fit
        };
        let truth = start("p_true");
        let predicted: Vec<f64> = motions.iter().flat_map(|motion| wide(&[truth.predict(motion)])).collect();
        readings.take_all(&predicted, &a["y_clean"].flat(), 1.0, "reading");
        clean.take_all(&wide(solved("y_clean").p()), &a["p_true"].flat(), 1.0, "without noise");
        let mut fit = solved("y_noisy");
        noisy.take_all(&wide(fit.p()), &a["p_est_noisy"].flat(), 1.0, "with noise");
        pass(&mut fit, "y_noisy");
        let cost = a["cost_noisy"].number();
        assert!((wide(&[fit.residual2()])[0] / cost - 1.0).abs() < tol(1e-9, 2e-2));
        let sigma = 1e-3 * a["p_true"][1].number(); // the file's noise: 1 mm/s^2
        for (got, want) in wide(&fit.deviation(sigma as Real).unwrap()).iter().zip(a["sd"].flat()) {
            deviations.take(*got, want, want, "deviation");
        }
    }
    readings.within(tol(1e-13, 1e-5), "calib_full readings [m/s^2]");
    clean.within(TOL_CLEAN, "calib_full parameters without noise");
    noisy.within(TOL_NOISY, "calib_full parameters with noise");
    deviations.within(TOL_SD_REL, "calib_full standard deviations, relative");
}

#[test]
fn geodesy_ecef_both_ways() {
    let file = load("geodesy.json");
    let (mut there, mut angle, mut height) = (Worst::default(), Worst::default(), Worst::default());
    for name in ["points", "ecef_global"] {
        for p in file[name].list() {
            let want = [p["X"].number(), p["Y"].number(), p["Z"].number()];
            let llh = [p["lat_deg"].number() * RAD, p["lon_deg"].number() * RAD, p["h"].number()];
            there.take_all(&wide(&geodesy::to_ecef(geodesy::grs80(), &real(llh)).unwrap()), &want, 1.0, name);
            let back = wide(&geodesy::from_ecef(geodesy::grs80(), &real(want)).unwrap());
            angle.take(back[0], llh[0], 1.0, name);
            let longitude = back[1] - llh[1];
            let turns = (longitude / (2.0 * PI)).round();
            angle.take((longitude - 2.0 * PI * turns) * llh[0].cos(), 0.0, 1.0, name);
            height.take(back[2], llh[2], 1.0, name);
        }
    }
    there.within(TOL_ECEF_M, "to ECEF [m]");
    angle.within(TOL_ANGLE_RAD, "from ECEF [rad]");
    height.within(TOL_ECEF_M, "from ECEF, height [m]");
}

#[test]
fn geodesy_tm2_of_twd97() {
    let (mut forward, mut inverse, mut convergence) = (Worst::default(), Worst::default(), Worst::default());
    let (mut thesis_forward, mut thesis_inverse) = (Worst::default(), Worst::default());
    for p in load("geodesy.json")["points"].list() {
        let ll = [p["lat_deg"].number() * RAD, p["lon_deg"].number() * RAD];
        let en = [p["E"].number(), p["N"].number()];
        let grid = Tm::twd97(if p["epsg"].integer() == 3826 { 121 } else { 119 }).unwrap();
        let [lat, lon] = real(ll);
        let (got, gamma) = grid.forward(lat, lon).unwrap();
        forward.take_all(&wide(&got), &en, 1.0, "EN");
        convergence.take_all(&wide(&[gamma]), &[p["convergence_deg"].number() * RAD], 1.0, "convergence");
        inverse.take_all(&wide(&grid.inverse(&real(en)).unwrap()), &ll, 1.0, "lat, lon");
        thesis_forward.take_all(&wide(&grid.thesis_forward(lat, lon).unwrap()), &en, 1.0, "EN");
        thesis_inverse.take_all(&wide(&grid.thesis_inverse(&real(en)).unwrap()), &ll, 1.0, "lat, lon");
    }
    forward.within(TOL_TM_M, "Krueger forward [m]");
    inverse.within(TOL_ANGLE_RAD, "Krueger inverse [rad]");
    convergence.within(TOL_CONVERGENCE_RAD, "convergence [rad]");
    thesis_forward.within(TOL_TM_M, "thesis forward [m]");
    thesis_inverse.within(TOL_THESIS_INVERSE_RAD, "thesis inverse [rad]");
}
