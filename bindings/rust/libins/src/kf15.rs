//! Covariance of the 15 errors of a strapdown: attitude, velocity, position, gyro and accelerometer bias; six scale factors beside it.
//!
//! Truth less estimate, in n (NED) and b; SI, rad. Symmetric, or as U D U' for float at any P0/R. Source: Groves 2013, Bierman 1977;
//! docs/kf15.md.
//!
//! ```
//! use libins::{coning::Form, kalman::Innovation, kf15, sculling::Increment, strapdown::{Position, Strapdown}};
//! # fn main() -> Result<(), libins::Error> {
//! let start = Position { anchor: [0.8, 0.2, 100.0], offset: [0.0; 3] };
//! let mut strapdown = Strapdown::new(Form::Hist2Opt, 0.01, &[1.0, 0.0, 0.0, 0.0], &[0.0; 3], &start)?;
//! let sensors = kf15::Sensors { arw: 1e-4, vrw: 1e-3, bg_sigma: 1e-4, bg_tau: 300.0, ba_sigma: 1e-2, ba_tau: 300.0 };
//! let mut model = kf15::Model::new(0.01, &sensors)?;
//! let mut filter = kf15::Kf15::new(&[0.1; kf15::N])?;
//! let increment = Increment { theta_b: [0.0; 3], v_b: [0.0, 0.0, -0.098] };
//! strapdown.step(&increment)?;
//! model.set(&strapdown, &increment.v_b);
//! filter.propagate(&model);
//! filter.update_state(kf15::P + 2, &Innovation { v: 0.3, r: 0.01, gate: 0.0 })?; // height: estimate i moves by gain()[i] v
//! assert!(filter.gain()[kf15::P + 2] > 0.4);
//! # Ok(())
//! # }
//! ```
//! SPDX-License-Identifier: MIT
use crate::kalman::Innovation;
use crate::sculling::Increment;
use crate::status::{fill, init};
use crate::strapdown::Strapdown;
use crate::{sys, Error, Real, Vec3};
use core::ffi::c_uint;

/// Errors.
pub const N: usize = sys::INS_KF15_N as usize;
/// Numbers of a row of P; the last is 0.
pub const ROW: usize = sys::INS_KF15_ROW as usize;
/// Scale factors: of gyros, of accelerometers.
pub const SCALES: usize = sys::INS_KF15_SCALE_N as usize;
/// Attitude, in n \[rad\], begins here.
pub const PHI: usize = sys::INS_KF15_PHI as usize;
/// Velocity, in n \[m/s\].
pub const V: usize = sys::INS_KF15_V as usize;
/// Position, north, east, down \[m\].
pub const P: usize = sys::INS_KF15_P as usize;
/// Gyro bias, in b \[rad/s\].
pub const BG: usize = sys::INS_KF15_BG as usize;
/// Accelerometer bias, in b \[m/s^2\].
pub const BA: usize = sys::INS_KF15_BA as usize;

/// What the sensors add: random walks, Gauss-Markov biases.
pub type Sensors = sys::ins_kf15_sensors_t;
/// Standard deviations and time constants of scale factors; 0.01 is a hundredth.
pub type ScaleSensors = sys::ins_kf15_scale_sensors_t;

/// F dt and Q of one step.
#[derive(Clone, Copy, Debug)]
pub struct Model(sys::ins_kf15_model_t);

impl Model {
    /// Steps of `dt` \[s\].
    pub fn new(dt: Real, sensors: &Sensors) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_kf15_model_init(s, dt, sensors) }).map(Self)
    }

    /// Of the step that ended at `at`, `v_b` the velocity increment of it \[m/s\].
    pub fn set(&mut self, at: &Strapdown, v_b: &Vec3) {
        // SAFETY: 3 numbers.
        unsafe { sys::ins_kf15_model(&mut self.0, at.raw(), v_b.as_ptr()) }
    }

    /// I + F dt, N by N, row-major.
    pub fn transition(&self) -> [Real; N * N] {
        // SAFETY: N N numbers out.
        fill(|out| unsafe { sys::ins_kf15_transition(&self.0, out) })
    }
}

/// P, symmetric.
#[derive(Clone, Copy, Debug)]
pub struct Kf15 {
    raw: sys::ins_kf15_t,
    nis: Real,
}

impl Kf15 {
    /// Standard deviations of the start.
    pub fn new(sigma: &[Real; N]) -> Result<Self, Error> {
        // SAFETY: N numbers.
        let raw = init(|s| unsafe { sys::ins_kf15_init(s, sigma.as_ptr()) })?;
        Ok(Self { raw, nis: 0.0 })
    }

    /// One step.
    pub fn propagate(&mut self, model: &Model) {
        // SAFETY: both are initialised.
        unsafe { sys::ins_kf15_propagate(&mut self.raw, &model.0) }
    }

    /// One scalar with the row `h` of H; what the gain corrects is the caller's.
    pub fn update(&mut self, h: &[Real; N], z: &Innovation) -> Result<(), Error> {
        let raw = &mut self.raw;
        // SAFETY: N numbers.
        z.put(&mut self.nis, |z| unsafe { sys::ins_kf15_update(raw, h.as_ptr(), z) })
    }

    /// The same for a row that is 1 at `index`, 0 elsewhere.
    pub fn update_state(&mut self, index: usize, z: &Innovation) -> Result<(), Error> {
        let index = c_uint::try_from(index).map_err(|_| Error::Range)?;
        let raw = &mut self.raw;
        // SAFETY: the index is judged.
        z.put(&mut self.nis, |z| unsafe { sys::ins_kf15_update_state(raw, index, z) })
    }

    /// P(i, j) at [`ROW`] i + j.
    pub fn p(&self) -> &[Real; N * ROW] {
        &self.raw.P
    }

    /// Gain of the last update.
    pub fn gain(&self) -> &[Real] {
        &self.raw.K[..N]
    }

    /// v^2 / (h P h' + r) of the last update, also of a refused one.
    pub fn nis(&self) -> Real {
        self.nis
    }
}

/// P = U D U'.
#[derive(Clone, Copy, Debug)]
pub struct Kf15Ud {
    raw: sys::ins_kf15_ud_t,
    nis: Real,
}

impl Kf15Ud {
    /// As [`Kf15::new`].
    pub fn new(sigma: &[Real; N]) -> Result<Self, Error> {
        // SAFETY: N numbers.
        let raw = init(|s| unsafe { sys::ins_kf15_ud_init(s, sigma.as_ptr()) })?;
        Ok(Self { raw, nis: 0.0 })
    }

    /// One step.
    pub fn propagate(&mut self, model: &Model) {
        // SAFETY: both are initialised.
        unsafe { sys::ins_kf15_ud_propagate(&mut self.raw, &model.0) }
    }

    /// As [`Kf15::update`].
    pub fn update(&mut self, h: &[Real; N], z: &Innovation) -> Result<(), Error> {
        let raw = &mut self.raw;
        // SAFETY: N numbers.
        z.put(&mut self.nis, |z| unsafe { sys::ins_kf15_ud_update(raw, h.as_ptr(), z) })
    }

    /// As [`Kf15::update_state`].
    pub fn update_state(&mut self, index: usize, z: &Innovation) -> Result<(), Error> {
        let index = c_uint::try_from(index).map_err(|_| Error::Range)?;
        let raw = &mut self.raw;
        // SAFETY: the index is judged.
        z.put(&mut self.nis, |z| unsafe { sys::ins_kf15_ud_update_state(raw, index, z) })
    }

    /// U D U', as [`Kf15::p`].
    pub fn p(&self) -> [Real; N * ROW] {
        // SAFETY: N ROW numbers out.
        fill(|out| unsafe { sys::ins_kf15_ud_covariance(&self.raw, out) })
    }

    /// Gain of the last update.
    pub fn gain(&self) -> &[Real] {
        &self.raw.K[..N]
    }

    /// As [`Kf15::nis`].
    pub fn nis(&self) -> Real {
        self.nis
    }
}

/// [`Kf15`] with six scale factors: 21 states.
#[derive(Clone, Copy, Debug)]
pub struct Kf15Scale {
    kf: Kf15,
    raw: sys::ins_kf15_scale_t,
}

impl Kf15Scale {
    /// Standard deviations of the 15 at the start; the scale factors begin as their sensors say.
    pub fn new(sigma: &[Real; N], sensors: &ScaleSensors) -> Result<Self, Error> {
        // SAFETY: both are valid.
        let raw = init(|s| unsafe { sys::ins_kf15_scale_init(s, sensors) })?;
        Ok(Self { kf: Kf15::new(sigma)?, raw })
    }

    /// One step of all 21, over the increment that the model was told.
    pub fn propagate(&mut self, model: &Model, increment: &Increment) {
        let (theta_b, v_b) = (increment.theta_b.as_ptr(), increment.v_b.as_ptr());
        // SAFETY: all are initialised, 3 numbers each.
        unsafe { sys::ins_kf15_scale_propagate(&mut self.raw, &mut self.kf.raw, &model.0, theta_b, v_b) }
    }

    /// One scalar with the rows `h` and `h_s` of H.
    pub fn update(&mut self, h: &[Real; N], h_s: &[Real; SCALES], z: &Innovation) -> Result<(), Error> {
        let (raw, kf) = (&mut self.raw, &mut self.kf.raw);
        // SAFETY: N and SCALES numbers.
        z.put(&mut self.kf.nis, |z| unsafe { sys::ins_kf15_scale_update(raw, kf, h.as_ptr(), h_s.as_ptr(), z) })
    }

    /// The 15: P, gain, nis.
    pub fn kf15(&self) -> &Kf15 {
        &self.kf
    }

    /// Variance of each scale factor.
    pub fn variances(&self) -> [Real; SCALES] {
        core::array::from_fn(|k| self.raw.B[(N + k) * SCALES + k])
    }

    /// Their gains of the last update.
    pub fn gain(&self) -> &[Real; SCALES] {
        &self.raw.K
    }
}
