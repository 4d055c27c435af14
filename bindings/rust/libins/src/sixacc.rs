//! Motion from six or more accelerometers without gyros, and their linear calibration. Frame: b. SI.
//!
//! Accelerometer j reads `bias + axis . (f + wd x r + w x (w x r))`; scale and misalignment are in its axis. docs/sixacc.md.
//! SPDX-License-Identifier: MIT
use crate::sculling::Increment;
use crate::status::{done, get, init, order, same_length};
use crate::{sys, Error, Order, Real, Vec3};
use core::ffi::c_uint;

/// Most accelerometers.
pub const MAX: usize = sys::INS_SIXACC_MAX as usize;

/// `bias` in units of the reading, `axis` in readings per m/s^2, `r` the place \[m\], both in b.
pub type Accel = sys::ins_accel_t;

/// The six of the paper, arm `rho` \[m\].
pub fn paper(rho: Real) -> [Accel; 6] {
    let mut accels = [Accel::default(); 6];
    // SAFETY: 6 accelerometers.
    unsafe { sys::ins_sixacc_paper(rho, accels.as_mut_ptr()) }
    accels
}

/// A reading without its accelerometer's quadratic term `k2` \[s^2/m\], as a calibration finds it.
pub fn linear(accel: &Accel, k2: Real, reading: Real) -> Real {
    // SAFETY: one accelerometer, read only.
    unsafe { sys::ins_accel_linear(accel, k2, reading) }
}

fn count(length: usize) -> Result<c_uint, Error> {
    c_uint::try_from(length).map_err(|_| Error::Range)
}

/// Geometry, and the state of the rate's integration.
#[derive(Clone, Copy, Debug)]
pub struct SixAcc(sys::ins_sixacc_t);

impl SixAcc {
    /// 6 to [`MAX`] accelerometers whose six unknowns are observable; the rate starts at 0.
    pub fn new(accels: &[Accel], period_s: Real) -> Result<Self, Error> {
        let n = count(accels.len())?;
        // SAFETY: n accelerometers.
        init(|s| unsafe { sys::ins_sixacc_init(s, n, accels.as_ptr(), period_s) }).map(Self)
    }

    /// One instant, for a known rate: angular acceleration \[rad/s^2\] and specific force \[m/s^2\].
    pub fn resolve(&self, readings: &[Real], w_ib_b: &Vec3) -> Result<(Vec3, Vec3), Error> {
        same_length(readings.len(), self.0.count.into())?;
        let (mut wd, mut f) = ([0.0; 3], [0.0; 3]);
        // SAFETY: a reading of each accelerometer, 3 numbers each.
        unsafe { sys::ins_sixacc_resolve(&self.0, readings.as_ptr(), w_ib_b.as_ptr(), wd.as_mut_ptr(), f.as_mut_ptr()) }
        Ok((wd, f))
    }

    /// Next sample; gives the increment over the last period, zero for the first.
    pub fn step(&mut self, readings: &[Real]) -> Result<(Increment, Order), Error> {
        same_length(readings.len(), self.0.count.into())?;
        let mut increment = Increment::default();
        // SAFETY: a reading of each accelerometer.
        let order = order(unsafe { sys::ins_sixacc_step(&mut self.0, readings.as_ptr(), &mut increment) })?;
        Ok((increment, order))
    }

    /// Rate at the last sample \[rad/s\].
    pub fn w_ib_b(&self) -> &Vec3 {
        &self.0.w_ib_b
    }

    /// Starts with a known rate \[rad/s\].
    pub fn set_w_ib_b(&mut self, w_ib_b: &Vec3) {
        self.0.w_ib_b = *w_ib_b;
    }

    /// Angular acceleration at the last sample \[rad/s^2\].
    pub fn wd_ib_b(&self) -> &Vec3 {
        &self.0.wd_ib_b
    }
}

/// Linear maps of accelerometers from readings in known attitudes, by least squares, row by row.
#[derive(Clone, Copy, Debug)]
pub struct LinFit(sys::ins_linfit_t);

impl LinFit {
    /// 1 to [`MAX`] accelerometers.
    pub fn new(accelerometers: usize) -> Result<Self, Error> {
        let n = count(accelerometers)?;
        // SAFETY: the state is a valid place.
        init(|s| unsafe { sys::ins_linfit_init(s, n) }).map(Self)
    }

    /// One attitude: the specific force \[m/s^2\] and a reading of each.
    pub fn add(&mut self, f_b: &Vec3, readings: &[Real]) -> Result<(), Error> {
        same_length(readings.len(), self.0.count.into())?;
        // SAFETY: 3 numbers, and a reading of each accelerometer.
        done(unsafe { sys::ins_linfit_add(&mut self.0, f_b.as_ptr(), readings.as_ptr()) })
    }

    /// Bias and axis of one; [`Error::State`] while the attitudes seen do not fix them.
    pub fn solve(&self, index: usize) -> Result<[Real; 4], Error> {
        let index = count(index)?;
        // SAFETY: 4 numbers out.
        get(|out| unsafe { sys::ins_linfit_solve(&self.0, index, out) })
    }

    /// Sum of squared residuals of each.
    pub fn residual2(&self) -> &[Real] {
        &self.0.residual2[..usize::from(self.0.count)]
    }
}
