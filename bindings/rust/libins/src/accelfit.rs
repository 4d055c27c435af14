//! One accelerometer in full, fitted on the target: bias, scale factor, misalignments, quadratic term and place. Frame: b. SI.
//!
//! Gauss-Newton: add every measurement, [`AccelFit::step`], and again until the step is small, some four passes. Parameters are b, SF, m1,
//! m2, k2, r\[3\] of a reading SF (b + x + k2 x^2). Source: Hung, Fang, Wang, Lee; docs/sixacc.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, get, init};
use crate::{sys, Error, Real, Vec3};

/// Parameters of one accelerometer.
pub const N: usize = sys::INS_ACCELFIT_N as usize;

/// What the fixture does: `f_b` \[m/s^2\], +g upwards at rest, `w_ib_b` \[rad/s\], `wd_ib_b` \[rad/s^2\].
pub type Motion = sys::ins_accelfit_motion_t;

/// The present estimate, and the rows of the present pass.
#[derive(Clone, Copy, Debug)]
pub struct AccelFit(sys::ins_accelfit_t);

impl AccelFit {
    /// Nominal axis, the two directions in which it may lean, and a first guess; SF not zero.
    pub fn new(u0: &Vec3, e1: &Vec3, e2: &Vec3, guess: &[Real; N]) -> Result<Self, Error> {
        // SAFETY: 3 numbers each, and 8.
        init(|s| unsafe { sys::ins_accelfit_init(s, u0.as_ptr(), e1.as_ptr(), e2.as_ptr(), guess.as_ptr()) }).map(Self)
    }

    /// What the accelerometer of the present estimate reads.
    pub fn predict(&self, motion: &Motion) -> Real {
        // SAFETY: both are valid; no derivatives are asked for.
        unsafe { sys::ins_accelfit_predict(&self.0, motion, core::ptr::null_mut()) }
    }

    /// One measurement.
    pub fn add(&mut self, motion: &Motion, reading: Real) -> Result<(), Error> {
        // SAFETY: both are valid.
        done(unsafe { sys::ins_accelfit_add(&mut self.0, motion, reading) })
    }

    /// Ends a pass; gives the largest component of the step. [`Error::State`] while the rows do not fix all eight parameters.
    pub fn step(&mut self) -> Result<Real, Error> {
        // SAFETY: 1 number out.
        get(|out| unsafe { sys::ins_accelfit_step(&mut self.0, out) }).map(|[largest]| largest)
    }

    /// Standard deviations by the rows of this pass, for the deviation `sigma` of one reading; before [`AccelFit::step`].
    pub fn deviation(&self, sigma: Real) -> Result<[Real; N], Error> {
        // SAFETY: 8 numbers out.
        get(|out| unsafe { sys::ins_accelfit_deviation(&self.0, sigma, out) })
    }

    /// The present estimate.
    pub fn p(&self) -> &[Real; N] {
        &self.0.p
    }

    /// Sum of squared residuals about the estimate in this pass.
    pub fn residual2(&self) -> Real {
        self.0.residual2
    }
}
