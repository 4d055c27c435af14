//! Vehicle filter: east, north, heading, speed, gyro bias, odometer scale. Frame as [`crate::dead_reckoning`]. docs/gps_dr.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, init};
use crate::{sys, Error, Real};

/// Growth of variances, variances of the measurements, gates.
pub type Config = sys::ins_unicycle_config_t;

/// The filter.
#[derive(Clone, Copy, Debug)]
pub struct Unicycle {
    raw: sys::ins_unicycle_t,
    nis: Real,
}

impl Unicycle {
    /// `x`: east, north \[m\], heading \[rad\], speed \[m/s\], gyro bias \[rad/s\], odometer scale; `var` their variances.
    pub fn new(config: &Config, x: &[Real; 6], var: &[Real; 6]) -> Result<Self, Error> {
        // SAFETY: 6 numbers each.
        let raw = init(|s| unsafe { sys::ins_unicycle_init(s, config, x.as_ptr(), var.as_ptr()) })?;
        Ok(Self { raw, nis: 0.0 })
    }

    /// Move by `dt` \[s\] with the gyro's yaw rate \[rad/s\].
    pub fn predict(&mut self, dt: Real, yaw_rate: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_unicycle_predict(&mut self.raw, dt, yaw_rate) })
    }

    /// Distance counted in the `dt` before \[m\].
    pub fn odometer(&mut self, dt: Real, distance: Real) -> Result<(), Error> {
        // SAFETY: both are valid.
        done(unsafe { sys::ins_unicycle_odometer(&mut self.raw, dt, distance, &mut self.nis) })
    }

    /// Known to stand still: the gyro reads its bias. `r_speed`: how sure \[(m/s)^2\].
    pub fn still(&mut self, yaw_rate: Real, r_speed: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_unicycle_still(&mut self.raw, yaw_rate, r_speed) })
    }

    /// A fix, variance `r` on each coordinate \[m^2\], judged as one.
    pub fn gps(&mut self, east: Real, north: Real, r: Real) -> Result<(), Error> {
        // SAFETY: both are valid.
        done(unsafe { sys::ins_unicycle_gps(&mut self.raw, east, north, r, &mut self.nis) })
    }

    /// State.
    pub fn x(&self) -> &[Real; 6] {
        &self.raw.x
    }

    /// Covariance, 6 by 6.
    pub fn p(&self) -> &[Real; 36] {
        &self.raw.P
    }

    /// Of the last odometer or GPS update, also of a refused one.
    pub fn nis(&self) -> Real {
        self.nis
    }
}
