//! Position, velocity and acceleration of one axis from fixes. Units: m, s. Source: the 2006 GIMU thesis, 5.10 to 5.24.
//! SPDX-License-Identifier: MIT
use crate::kalman::Innovation;
use crate::status::{done, init};
use crate::{sys, Error, Mat3, Real, Vec3};

/// What was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum What {
    /// \[m\]
    Position = sys::INS_PVA_POSITION as i32,
    /// \[m/s\]
    Velocity = sys::INS_PVA_VELOCITY as i32,
    /// \[m/s^2\]
    Acceleration = sys::INS_PVA_ACCELERATION as i32,
}

/// The filter of one axis.
#[derive(Clone, Copy, Debug)]
pub struct Pva {
    raw: sys::ins_pva_t,
    nis: Real,
}

impl Pva {
    /// State 0 with the variances `var`.
    pub fn new(var: &Vec3) -> Result<Self, Error> {
        // SAFETY: 3 numbers.
        let raw = init(|s| unsafe { sys::ins_pva_init(s, var.as_ptr()) })?;
        Ok(Self { raw, nis: 0.0 })
    }

    /// `dt` \[s\], `q` spectral density of the jerk \[m^2/s^5\], both >= 0.
    pub fn predict(&mut self, dt: Real, q: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_pva_predict(&mut self.raw, dt, q) })
    }

    /// [`Innovation::v`] is the measurement less the state it measures.
    pub fn update(&mut self, what: What, z: &Innovation) -> Result<(), Error> {
        let raw = &mut self.raw;
        // SAFETY: both are valid.
        z.put(&mut self.nis, |innovation| unsafe { sys::ins_pva_update(raw, what as i32, innovation) })
    }

    /// Position, velocity, acceleration.
    pub fn x(&self) -> &Vec3 {
        &self.raw.x
    }

    /// Sets the state, say at the start.
    pub fn set_x(&mut self, x: &Vec3) {
        self.raw.x = *x;
    }

    /// Covariance.
    pub fn p(&self) -> &Mat3 {
        &self.raw.P
    }

    /// Gain of the last update.
    pub fn gain(&self) -> &Vec3 {
        &self.raw.K
    }

    /// Of the last update, also of a refused one.
    pub fn nis(&self) -> Real {
        self.nis
    }
}
