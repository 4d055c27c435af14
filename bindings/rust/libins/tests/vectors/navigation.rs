//! sculling.json, sixacc.json, calib_linear.json, calib_full.json, geodesy.json.
//! SPDX-License-Identifier: MIT
use crate::json::Json;
use crate::{load, real, tol, wide, Worst};
use libins::coning::Form;
use libins::sculling::{self, Increment};
use libins::sixacc::{self, Accel, LinFit, SixAcc};
use libins::tm::Tm;
use libins::{geodesy, quat, Error, Real};
use std::f64::consts::PI;

const TOL_DV_REL: f64 = tol(1e-12, 3e-7);
const TOL_SIXACC_REL: f64 = tol(1e-12, 1e-6); // of the largest reading, and of it over the arm
const TOL_MAP: f64 = tol(1e-12, 2e-6);
const TOL_CALIBRATED: f64 = tol(1e-10, 1e-4); // rad/s^2 and m/s^2, from readings of up to 60 m/s^2 on arms of 0.1 m
const TOL_ECEF_M: f64 = tol(1e-8, 6.0);
const TOL_ANGLE_RAD: f64 = tol(1e-13, 5e-7);
const TOL_TM_M: f64 = tol(1e-6, 2.0);
const TOL_THESIS_INVERSE_RAD: f64 = tol(1e-4 / 6.4e6, 5e-7);
const TOL_CONVERGENCE_RAD: f64 = tol(5e-8, 3e-7); // the file's is a difference quotient
const RAD: f64 = PI / 180.0;

fn norm(v: [f64; 3]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
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

/// The file's model has a quadratic term and is estimated by Levenberg-Marquardt, which is not in the core. With the quadratic term
/// taken off, its readings are those of the core's accelerometer: the fit must find its map, and six resolved must give the motion.
#[test]
fn calib_full_without_the_quadratic_term() {
    let file = load("calib_full.json");
    let (mut maps, mut motions) = (Worst::default(), Worst::default());
    let (mut accels, mut columns) = (Vec::new(), Vec::new());
    let rows: Vec<[[f64; 3]; 3]> = file["meas"]
        .arrays::<9>()
        .iter()
        .map(|m| [[m[0], m[1], m[2]].map(|x| x * file["g"].number()), [m[3], m[4], m[5]], [m[6], m[7], m[8]]])
        .collect();
    for a in file["acc"].list() {
        let [b, sf, m1, m2, k2, rx, ry, rz] = a["p_true"].array();
        let (u0, e1, e2): ([f64; 3], [f64; 3], [f64; 3]) = (a["u0"].array(), a["e1"].array(), a["e2"].array());
        let u: [f64; 3] = std::array::from_fn(|i| u0[i] + m1 * e1[i] + m2 * e2[i]);
        let axis = u.map(|x| sf * x / norm(u));
        let mut fit = LinFit::new(1).unwrap();
        let mut column = Vec::new();
        for ([f, w, wd], y) in rows.iter().zip(a["y_clean"].flat()) {
            let (tangential, radial) = (cross(*wd, [rx, ry, rz]), cross(*w, cross(*w, [rx, ry, rz])));
            let x = dot(std::array::from_fn(|i| f[i] + tangential[i] + radial[i]), axis) / sf;
            let linear = y - sf * k2 * x * x;
            column.push(linear);
            if norm(*w) + norm(*wd) == 0.0 {
                fit.add(&real(*f), &[linear as Real]).unwrap();
            }
        }
        let map = [sf * b, axis[0], axis[1], axis[2]];
        maps.take_all(&wide(&fit.solve(0).unwrap()), &map, 1.0, "map");
        accels.push(Accel { bias: map[0] as Real, axis: real(axis), r: real([rx, ry, rz]) });
        columns.push(column);
    }
    let six = SixAcc::new(&accels, 0.01).unwrap();
    for (k, [f, w, wd]) in rows.iter().enumerate() {
        let readings: Vec<f64> = columns.iter().map(|column| column[k]).collect();
        let (got_wd, got_f) = six.resolve(&reals(&readings), &real(*w)).unwrap();
        motions.take_all(&wide(&got_wd), wd, 1.0, "wd");
        motions.take_all(&wide(&got_f), f, 1.0, "f");
    }
    maps.within(TOL_MAP, "calib_full, linear map at rest");
    motions.within(TOL_CALIBRATED, "calib_full, motion from six calibrated accelerometers");
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
