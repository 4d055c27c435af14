//! coning.json, attitude_motion.json, quaternion.json.
//! SPDX-License-Identifier: MIT
use crate::json::Json;
use crate::{load, real, tol, wide, Worst};
use libins::attitude::Attitude;
use libins::coning::{self, Form};
use libins::fiter::{self, Fiter};
use libins::rates::Rates;
use libins::reuse::Reuse;
use libins::thesis::{self, Rk4, Thesis};
use libins::{quat, Order, Real};
use std::f64::consts::PI;

const TOL_ONE_STEP: f64 = tol(1e-12, 4e-7); // component
const TOL_PHI_REL: f64 = tol(1e-12, 5e-7);
const TOL_CONING: f64 = tol(1e-12, 4e-7); // component or rad, after 36 steps
const TOL_MOTION: f64 = tol(1e-12, 4e-6); // component, after 300 steps
const TOL_MOTION_RAD: f64 = tol(1e-12, 8e-6); // rad, over 300 steps
const TOL_EULER_RAD: f64 = tol(1e-12, 5e-7);
const TOL_COEFFICIENT: f64 = tol(1e-15, 1e-7);

const FORMS: [(&str, Form); 11] = [
    ("one", Form::One),
    ("two", Form::Block2),
    ("three_poly", Form::Block3Fit),
    ("three_opt", Form::Block3Opt),
    ("four_poly", Form::Block4Fit),
    ("four_opt", Form::Block4Opt),
    ("hist1", Form::Hist1),
    ("hist2_poly", Form::Hist2Fit),
    ("hist2_opt", Form::Hist2Opt),
    ("hist3_poly", Form::Hist3Fit),
    ("hist3_opt", Form::Hist3Opt),
];
const FITERS: [(&str, fiter::Form); 5] = [
    ("fhist2", fiter::Form::Hist2),
    ("fhist3", fiter::Form::Hist3),
    ("ratefit3", fiter::Form::Rate3),
    ("ratefit4", fiter::Form::Rate4),
    ("ratefit5", fiter::Form::Rate5),
];
const ADAMS_MOULTON: [(&str, u8); 3] = [("rates_trap+hist2_opt", 2), ("rates_am3+hist2_opt", 3), ("rates_am4+hist2_opt", 4)];
/// In the files as warnings, or for another calculation: the core does not have them.
const NOT_IN_CORE: [&str; 4] = ["reuse_naive", "reuse_naive_avg", "reuse_naive_cross", "rates_left+hist2_opt"];

type Quat = [f64; 4];
type Vec3 = [f64; 3];
/// (index of the last increment used, from 1; attitude)
type Track = Vec<(usize, Quat)>;

fn mul(p: Quat, q: Quat) -> Quat {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

/// Rotation vector of a b*, in n.
fn rotation_between(a: Quat, b: Quat) -> Vec3 {
    let mut d = mul(a, [b[0], -b[1], -b[2], -b[3]]);
    if d[0] < 0.0 {
        d = d.map(|x| -x);
    }
    let s = (d[1] * d[1] + d[2] * d[2] + d[3] * d[3]).sqrt();
    let k = if s > 0.0 { 2.0 * s.atan2(d[0]) / s } else { 2.0 };
    [k * d[1], k * d[2], k * d[3]]
}

fn norm(v: Vec3) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

fn take_quat(worst: &mut Worst, got: Quat, want: Quat, place: &str) {
    let dot: f64 = got.iter().zip(want).map(|(g, w)| g * w).sum();
    worst.take_all(&got.map(|g| if dot < 0.0 { -g } else { g }), &want, 1.0, place);
}

fn form_named(name: &str) -> Option<Form> {
    FORMS.iter().find(|entry| entry.0 == name).map(|entry| entry.1)
}

/// `pre`: increments before the first, for the history forms.
fn run_form(form: Form, start: Quat, pre: &[Vec3], increments: &[Vec3]) -> Track {
    let q0 = real(start);
    let mut track = vec![(0, start)];
    if form.is_block() {
        let mut q = q0;
        for (k, block) in increments.chunks_exact(form.samples()).enumerate() {
            let theta: Vec<_> = block.iter().map(|v| real(*v)).collect();
            let dq = quat::from_rotvec(&coning::phi(form, &theta).unwrap()).unwrap();
            q = quat::mul(&q, &dq);
            quat::normalise_approx(&mut q);
            track.push(((k + 1) * form.samples(), wide(&q)));
        }
        return track;
    }
    let mut attitude = Attitude::new(form, &q0).unwrap();
    for theta in pre {
        attitude.step(&real(*theta)).unwrap();
    }
    attitude.set_q_nb(&q0);
    for (k, theta) in increments.iter().enumerate() {
        assert_eq!(attitude.step(&real(*theta)), Ok(Order::Full));
        track.push((k + 1, wide(attitude.q_nb())));
    }
    track
}

fn run_reuse(form: Form, truth: &[Quat], increments: &[Vec3]) -> Track {
    let mut reuse = Reuse::new(form, &[real(truth[0]), real(truth[1]), real(truth[2])]).unwrap();
    let steps = increments.iter().enumerate().map(|(k, theta)| {
        let (q, order) = reuse.step(&real(*theta)).unwrap();
        assert_eq!(order == Order::StartUp, k < 2);
        (k + 1, wide(&q))
    });
    std::iter::once((0, truth[0])).chain(steps).collect()
}

fn run_rates(order: u8, period: f64, start: Quat, rates: &[Vec3], lead: usize) -> Track {
    let mut integrator = Rates::new(order, period as Real).unwrap();
    let (mut pre, mut increments) = (Vec::new(), Vec::new());
    for (k, w) in rates.iter().enumerate() {
        let (theta, got) = integrator.add(&real(*w)).unwrap();
        assert_eq!(got == Order::StartUp, k + 1 < usize::from(order));
        if got == Order::Full {
            if k <= lead { &mut pre } else { &mut increments }.push(wide(&theta));
        }
    }
    run_form(Form::Hist2Opt, start, &pre, &increments)
}

fn run_fiter(form: fiter::Form, period: f64, start: Quat, before: &[Vec3], samples: &[Vec3]) -> Track {
    let mut f = Fiter::new(form, period as Real, &real(start)).unwrap();
    for sample in before {
        f.step(&real(*sample)).unwrap();
    }
    f.set_q_nb(&real(start));
    let steps = samples.iter().enumerate().map(|(k, sample)| {
        assert_eq!(f.step(&real(*sample)), Ok(Order::Full));
        (k + 1, wide(f.q_nb()))
    });
    std::iter::once((0, start)).chain(steps).collect()
}

fn run_fiter_blocks(start: Quat, increments: &[Vec3]) -> Track {
    let mut q = real(start);
    let steps = increments.chunks_exact(3).enumerate().map(|(k, block)| {
        let theta: Vec<_> = block.iter().map(|v| real(*v)).collect();
        q = quat::mul(&q, &fiter::turn(fiter::Form::Block3, &theta).unwrap());
        quat::normalise_approx(&mut q);
        (3 * (k + 1), wide(&q))
    });
    std::iter::once((0, start)).chain(steps).collect()
}

fn run_thesis(start: Quat, before: Vec3, increments: &[Vec3]) -> Track {
    let mut t = Thesis::new(&real(start)).unwrap();
    assert_eq!(t.step(&real(before)), Ok(Order::StartUp));
    t.set_q_nb(&real(start));
    let steps = increments.iter().enumerate().map(|(k, theta)| {
        assert_eq!(t.step(&real(*theta)), Ok(Order::Full));
        (k + 1, wide(t.q_nb()))
    });
    std::iter::once((0, start)).chain(steps).collect()
}

/// rates[2 i], [2 i + 1], [2 i + 2] are those of step i.
fn run_rk4(step_s: f64, normalise: bool, start: Quat, rates: &[Vec3]) -> Track {
    let mut rk4 = Rk4::new(0.0, step_s as Real, &real(start), &real(rates[0])).unwrap();
    let steps = rates[1..].chunks_exact(2).enumerate().map(|(k, pair)| {
        assert_eq!(rk4.step(&real(pair[0]), &real(pair[1])), Ok(Order::Full));
        if normalise {
            let mut q = *rk4.q_nb();
            quat::normalise(&mut q).unwrap();
            rk4.set_q_nb(&q);
        }
        (2 * (k + 1), wide(rk4.q_nb()))
    });
    std::iter::once((0, start)).chain(steps).collect()
}

/// A result of coning.json or attitude_motion.json by its name.
fn run_named(name: &str, c: &Json, truth: &[Quat], increments: &[Vec3]) -> Option<Track> {
    let pre = c["pre"].arrays();
    let tail = &pre[pre.len() - 3..];
    if let Some(form) = form_named(name) {
        return Some(run_form(form, truth[0], tail, increments));
    }
    match name {
        "reuse_interleaved_poly" => return Some(run_reuse(Form::Block3Fit, truth, increments)),
        "reuse_interleaved_opt" => return Some(run_reuse(Form::Block3Opt, truth, increments)),
        "thesis2" => return Some(run_thesis(truth[0], *pre.last().unwrap(), increments)),
        "fiter3" => return Some(run_fiter_blocks(truth[0], increments)),
        _ => {}
    }
    let rates = c.find("rates")?.arrays();
    let lead = (-c["rates_first_k"].number()) as usize;
    let period = c["T"].number();
    if name == "rk4_2T" {
        return Some(run_rk4(2.0 * period, true, truth[0], &rates[lead..]));
    }
    if let Some((_, order)) = ADAMS_MOULTON.iter().find(|entry| entry.0 == name) {
        return Some(run_rates(*order, period, truth[0], &rates, lead));
    }
    let (_, form) = FITERS.iter().find(|entry| entry.0 == name)?;
    Some(if name.starts_with("rate") {
        run_fiter(*form, period, truth[0], &rates[..=lead], &rates[lead + 1..=lead + c["n"].integer()])
    } else {
        run_fiter(*form, 1.0, truth[0], &pre, increments)
    })
}

#[test]
fn coning_coefficients() {
    let file = load("coning.json");
    let mut worst = Worst::default();
    for (name, rows) in file["coefficients"].entries() {
        let form = form_named(name).unwrap();
        let n = form.samples();
        for i in 1..=n {
            for j in i + 1..=n {
                let row = rows.list().iter().find(|row| row[0].integer() == i && row[1].integer() == j);
                let want = row.map_or(0.0, |row| row[2].number() / row[3].number());
                // theta_i along x and theta_j along y: the z of phi is the coefficient.
                let mut theta = vec![[0.0; 3]; n];
                theta[i - 1][0] = 1.0;
                theta[j - 1][1] = 1.0;
                worst.take(wide(&coning::phi(form, &theta).unwrap())[2], want, 1.0, name);
            }
        }
    }
    worst.within(TOL_COEFFICIENT, "coning coefficients");
}

#[test]
fn coning_first_interval() {
    let file = load("coning.json");
    let (mut vectors, mut p) = (Worst::default(), Worst::default());
    for c in file["cases"].list() {
        let (pre, incs): (Vec<Vec3>, Vec<Vec3>) = (c["pre"].arrays(), c["incs"].arrays());
        for (name, want) in c["phi_first"].entries() {
            let Some(form) = form_named(name) else {
                assert_eq!(name, "thesis_P_unnormalised");
                let got = thesis::p(&real(incs[0]), &real(*pre.last().unwrap()));
                p.take_all(&wide(&got), &want.flat(), 1.0, name);
                continue;
            };
            let back = if form.is_block() { 0 } else { form.samples() - 1 };
            let read = pre[pre.len() - back..].iter().chain(&incs).take(form.samples());
            let theta: Vec<_> = read.map(|v| real(*v)).collect();
            vectors.take_all(&wide(&coning::phi(form, &theta).unwrap()), &want.flat(), norm(want.array()), name);
        }
    }
    vectors.within(TOL_PHI_REL, "coning phi, relative");
    p.within(TOL_ONE_STEP, "thesis P");
}

#[test]
fn coning_attitude_after_the_increments() {
    let file = load("coning.json");
    let (mut quats, mut errors, mut rk4) = (Worst::default(), Worst::default(), Worst::default());
    for c in file["cases"].list() {
        let (truth, incs): (Vec<Quat>, Vec<Vec3>) = (c["q_true"].arrays(), c["incs"].arrays());
        for (name, want) in c["q_final"].entries() {
            let Some(track) = run_named(name, c, &truth, &incs) else {
                assert!(NOT_IN_CORE.contains(&name.as_str()), "{name}");
                continue;
            };
            let q = track.last().unwrap().1;
            take_quat(&mut quats, q, want.array(), name);
            let error = rotation_between(q, *truth.last().unwrap());
            errors.take_all(&error, &c["att_err_final"][name.as_str()].flat(), 1.0, name);
        }
        let track = run_rk4(c["h"].number(), false, truth[0], &c["rates_half_step"].arrays());
        take_quat(&mut rk4, track.last().unwrap().1, c["rk4_q_after_12_unnormalised"].array(), "rk4");
    }
    quats.within(TOL_CONING, "coning q_final");
    errors.within(TOL_CONING, "coning att_err_final [rad]");
    rk4.within(TOL_CONING, "rk4 in coning");
}

#[cfg(not(feature = "float"))]
#[test]
fn coning_drift_over_whole_cycles() {
    const CYCLES: usize = 12;
    const TOL_RAD_S: f64 = 2e-15; // 1e-16 a step
    const TOL_REL: f64 = 2e-5; // the file's "measured" holds a transient of some 1e-6
    for c in load("coning.json")["cases"].list() {
        let (a, h, omega) = (c["half_angle_deg"].number() * PI / 180.0, c["h"].number(), c["omega"].number());
        let per_cycle = c["increments_per_cycle"].integer();
        let increment = |k: i32| {
            let from = omega * (c["t0"].number() + f64::from(k) * h);
            let to = from + omega * h;
            // Differences of cosines and sines as products: no cancellation.
            let chord = 2.0 * a.sin() * (omega * h / 2.0).sin();
            [-2.0 * omega * h * (a / 2.0).sin().powi(2), -chord * ((from + to) / 2.0).sin(), chord * ((from + to) / 2.0).cos()]
        };
        let pre: Vec<Vec3> = (-3..0).map(increment).collect();
        let incs: Vec<Vec3> = (0..(CYCLES * per_cycle) as i32).map(increment).collect();
        let start = c["q_true"][0].array();
        let mut forms = 0;
        for (name, want) in c["drift_x"].entries() {
            let Some(form) = form_named(name) else { continue }; // the chains drift as their block form does
            let track = run_form(form, start, &pre, &incs);
            let (used, q) = track.last().unwrap();
            assert_eq!(*used, incs.len(), "{name}");
            let drift = rotation_between(*q, start)[0] / (incs.len() as f64 * h);
            let measured = want["measured"].number();
            let tolerance = TOL_RAD_S + TOL_REL * measured.abs();
            assert!((drift - measured).abs() <= tolerance, "{name}, {per_cycle} a cycle: {drift} rad/s, want {measured}");
            forms += 1;
        }
        assert!(forms >= 10, "{forms} forms");
    }
}

/// roll, pitch, yaw, away from the poles.
fn euler_of(q: Quat) -> Vec3 {
    [
        (2.0 * (q[2] * q[3] + q[0] * q[1])).atan2(q[0] * q[0] - q[1] * q[1] - q[2] * q[2] + q[3] * q[3]),
        (-2.0 * (q[1] * q[3] - q[0] * q[2])).asin(),
        (2.0 * (q[1] * q[2] + q[0] * q[3])).atan2(q[0] * q[0] + q[1] * q[1] - q[2] * q[2] - q[3] * q[3]),
    ]
}

/// To (-pi, pi].
fn wrap(angle: f64) -> f64 {
    angle - 2.0 * PI * (angle / (2.0 * PI)).round()
}

#[test]
fn attitude_motion() {
    let file = load("attitude_motion.json");
    let (mut quats, mut errors, mut runs) = (Worst::default(), Worst::default(), 0);
    for c in file["cases"].list() {
        let (truth, incs): (Vec<Quat>, Vec<Vec3>) = (c["q_true"].arrays(), c["incs"].arrays());
        for (name, want) in c["results"].entries() {
            let Some(track) = run_named(name, c, &truth, &incs) else {
                assert!(NOT_IN_CORE.contains(&name.as_str()), "{name}");
                continue;
            };
            let (k, q) = *track.last().unwrap();
            assert_eq!(k, want["k_final"].integer(), "{name}");
            take_quat(&mut quats, q, want["q_final"].array(), name);
            let angles: Vec<f64> = track.iter().map(|(k, q)| norm(rotation_between(*q, truth[*k]))).collect();
            let max = angles.iter().copied().fold(0.0, f64::max);
            let rms = (angles.iter().map(|e| e * e).sum::<f64>() / angles.len() as f64).sqrt();
            errors.take(max, want["max_err"].number(), 1.0, &format!("{name} max"));
            if form_named(name).is_some() {
                let differences = track.iter().map(|(k, q)| (euler_of(*q), euler_of(truth[*k])));
                let yaw: Vec<f64> = differences.map(|(got, exact)| wrap(got[2] - exact[2])).collect();
                errors.take(rms, want["rms_err"].number(), 1.0, &format!("{name} rms"));
                errors.take(yaw.iter().copied().fold(0.0, f64::min), want["yaw_err_min"].number(), 1.0, &format!("{name} yaw min"));
                errors.take(yaw.iter().copied().fold(0.0, f64::max), want["yaw_err_max"].number(), 1.0, &format!("{name} yaw max"));
            }
            runs += 1;
        }
    }
    assert!(runs >= 4 * 20, "{runs} runs");
    quats.within(TOL_MOTION, "attitude_motion q_final");
    errors.within(TOL_MOTION_RAD, "attitude_motion errors [rad]");
}

#[test]
fn quaternion_euler_and_direction_cosines() {
    let file = load("quaternion.json");
    let (mut quats, mut dcm, mut angles) = (Worst::default(), Worst::default(), Worst::default());
    for c in file["euler"].list() {
        let euler = [c["roll"].number(), c["pitch"].number(), c["yaw"].number()];
        let want = c["q"].array();
        take_quat(&mut quats, wide(&quat::from_euler(&real(euler))), want, "from_euler");
        dcm.take_all(&wide(&quat::to_dcm(&real(want))), &c["C_bn"].flat(), 1.0, "C_bn");
        take_quat(&mut quats, wide(&quat::from_dcm(&real(c["C_bn"].array())).unwrap()), want, "from_dcm");
        let back = wide(&quat::to_euler(&real(want)));
        let expected: Vec3 = c["euler_back"].array();
        // Near a pole roll and yaw are known to the rounding of q over cos(pitch); the rotation is known everywhere.
        let near_pole = euler[1].cos();
        if near_pole > 1e-3 {
            let difference = [near_pole * wrap(back[0] - expected[0]), back[1] - expected[1], near_pole * wrap(back[2] - expected[2])];
            angles.take_all(&difference, &[0.0; 3], 1.0, "to_euler");
        }
        take_quat(&mut quats, wide(&quat::from_euler(&real(back))), want, "to_euler and back");
    }
    quats.within(TOL_ONE_STEP, "quaternion from Euler, DCM");
    dcm.within(TOL_ONE_STEP, "C_bn");
    angles.within(TOL_EULER_RAD, "quaternion to Euler [rad]");
}

#[test]
fn quaternion_products_and_the_thesis() {
    let file = load("quaternion.json");
    let mut worst = Worst::default();
    for c in file["products"].list() {
        let (a, b, v): (Quat, Quat, Vec3) = (c["a"].array(), c["b"].array(), c["v"].array());
        take_quat(&mut worst, wide(&quat::mul(&real(a), &real(b))), c["ab"].array(), "product");
        worst.take_all(&wide(&quat::rotate(&real(a), &real(v))), &c["rot"].flat(), norm(v).max(1.0), "rotate");
        let unturned = quat::rotate(&quat::conj(&real(a)), &real(c["rot"].array()));
        worst.take_all(&wide(&unturned), &v, norm(v).max(1.0), "rotate back");
        take_quat(&mut worst, wide(&quat::from_rotvec(&real(c["rv"].array())).unwrap()), c["q_rv"].array(), "from_rotvec");
        let mut longer = real(a.map(|x| 1.001 * x));
        quat::normalise_approx(&mut longer);
        take_quat(&mut worst, wide(&longer), c["norm_approx"].array(), "normalise_approx");
        let p = thesis::p(&real(c["rv"].array()), &real(c["thesis_P_prev"].array()));
        let want: Quat = c["thesis_P"].array();
        worst.take_all(&wide(&p), &want, want[0].abs().max(1.0), "thesis P");
    }
    for c in file["zxz"].list() {
        let turned = wide(&thesis::zxz(&real([c["alpha"].number(), c["beta"].number(), c["gamma"].number()])));
        worst.take_all(&turned, &c["R"].flat(), 1.0, "zxz R");
        worst.take_all(&turned[..3], &c["S"].flat(), 1.0, "zxz S");
    }
    worst.within(TOL_ONE_STEP, "quaternion products, thesis P, zxz");
}
