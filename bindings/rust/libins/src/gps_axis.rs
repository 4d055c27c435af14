//! Filter of one coordinate of a GPS fix: position, velocity, acceleration (Singer), and a correlated fix error. Units: m, s.
//!
//! Source: the ARM vehicle navigator paper of the GPS/DR system, 1.2.1; docs/gps_dr.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, init};
use crate::{sys, Error, Real};

/// Epoch, time constants, deviations, variance of a fix, gate.
pub type Config = sys::ins_gps_axis_config_t;

/// The filter of one coordinate.
#[derive(Clone, Copy, Debug)]
pub struct GpsAxis {
    raw: sys::ins_gps_axis_t,
    nis: Real,
}

impl GpsAxis {
    /// State 0 with the variances `var`; refused if the two time constants are too close to be told apart.
    pub fn new(config: &Config, var: &[Real; 4]) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        let raw = init(|s| unsafe { sys::ins_gps_axis_init(s, config, var.as_ptr()) })?;
        Ok(Self { raw, nis: 0.0 })
    }

    /// One epoch on without a fix.
    pub fn predict(&mut self) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_gps_axis_predict(&mut self.raw) }
    }

    /// One epoch on, then the fix \[m\]; when it is refused the epoch is predicted all the same.
    pub fn step(&mut self, z: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_axis_step(&mut self.raw, z, &mut self.nis) })
    }

    /// Position, velocity, acceleration, fix error.
    pub fn x(&self) -> &[Real; 4] {
        &self.raw.x
    }

    /// Sets the state, say at the start.
    pub fn set_x(&mut self, x: &[Real; 4]) {
        self.raw.x = *x;
    }

    /// Covariance, 4 by 4.
    pub fn p(&self) -> &[Real; 16] {
        &self.raw.P
    }

    /// Transition over an epoch, 4 by 4.
    pub fn phi(&self) -> &[Real; 16] {
        &self.raw.Phi
    }

    /// Gain of the last update.
    pub fn gain(&self) -> &[Real; 4] {
        &self.raw.K
    }

    /// Of the last fix, also of a refused one.
    pub fn nis(&self) -> Real {
        self.nis
    }
}
