//! Dead reckoning from a yaw-rate gyro and an odometer: the classic sums, and the extended filter of the GPS/DR paper.
//!
//! Frame: east, north \[m\]; heading clockwise from north \[rad\]. The filter is for comparison, [`crate::unicycle`] is the one to use.
//! SPDX-License-Identifier: MIT
use crate::status::{done, init};
use crate::{sys, Error, Real, Vec3};

/// One step along a circular arc: `pose` is east, north, heading; `distance` \[m\], `turn` \[rad\] clockwise.
pub fn step(pose: &mut Vec3, distance: Real, turn: Real) -> Result<(), Error> {
    // SAFETY: 3 numbers.
    done(unsafe { sys::ins_dead_reckoning_step(pose.as_mut_ptr(), distance, turn) })
}

/// Step, correlation of the acceleration, variances, speed limits, gate.
pub type Config = sys::ins_dr_ekf_config_t;

/// The paper's filter.
#[derive(Clone, Copy, Debug)]
pub struct DrEkf(sys::ins_dr_ekf_t);

impl DrEkf {
    /// `x`: east, north, their velocities, their accelerations; `var` their variances.
    pub fn new(config: &Config, x: &[Real; 6], var: &[Real; 6]) -> Result<Self, Error> {
        // SAFETY: 6 numbers each.
        init(|s| unsafe { sys::ins_dr_ekf_init(s, config, x.as_ptr(), var.as_ptr()) }).map(Self)
    }

    /// Predict, then update with what may be used. [`Error::Gate`]: one or both were refused by the gate.
    pub fn step(&mut self, yaw_rate: Real, distance: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_dr_ekf_step(&mut self.0, yaw_rate, distance) })
    }

    /// State.
    pub fn x(&self) -> &[Real; 6] {
        &self.0.x
    }

    /// Covariance, 6 by 6.
    pub fn p(&self) -> &[Real; 36] {
        &self.0.P
    }

    /// Whether the last step used the yaw rate, and the distance.
    pub fn used(&self) -> (bool, bool) {
        (self.0.used & sys::INS_DR_RATE != 0, self.0.used & sys::INS_DR_DISTANCE != 0)
    }

    /// nis of yaw rate and distance in the last step; 0 if not looked at.
    pub fn nis(&self) -> &[Real; 2] {
        &self.0.nis
    }

    /// Measurements refused by the gate so far.
    pub fn gated(&self) -> u32 {
        self.0.gated
    }
}
