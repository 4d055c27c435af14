//! GPS and dead reckoning of a vehicle, decentralised: it finds its heading, shares information, switches. Units: m, s, rad.
//!
//! Frame as [`crate::dead_reckoning`]; the state is that of [`crate::unicycle`]. docs/gps_dr.md.
//!
//! ```
//! use libins::gps_dr::{config, Fix, GpsDr, Source};
//! # fn main() -> Result<(), libins::Error> {
//! let mut nav = GpsDr::new(&config())?;
//! let mut north = 0.0;
//! for k in 0..50 {
//!     nav.step(0.1, 0.0, 0.8)?; // yaw rate, distance
//!     north += 0.8;
//!     if k % 10 == 0 {
//!         nav.fix(&Fix { north, sigma: 3.0, speed: 8.0, valid: 1, sats: 8, has_course: 1, ..Fix::default() })?;
//!     }
//! }
//! assert_eq!(nav.source(), Source::Gps);
//! assert!((nav.state()?.0[1] - north).abs() < 3.0);
//! # Ok(())
//! # }
//! ```
//! SPDX-License-Identifier: MIT
use crate::status::{done, init};
use crate::{sys, Error, Real};

/// Noise, switch, what the start knows.
pub type Config = sys::ins_gps_dr_config_t;
/// What a receiver says.
pub type Fix = sys::ins_gps_dr_fix_t;

/// What the state rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// No fix yet.
    None,
    /// Fixes; the heading is being found.
    Align,
    /// Dead reckoning.
    Dr,
    /// GPS.
    Gps,
}

/// A car with a MEMS gyro and wheel pulses, a receiver between buildings.
pub fn config() -> Config {
    let mut config = Config::default();
    // SAFETY: a valid place.
    unsafe { sys::ins_gps_dr_config_default(&mut config) }
    config
}

/// The pair.
#[derive(Clone, Copy, Debug)]
pub struct GpsDr(sys::ins_gps_dr_t);

impl GpsDr {
    /// Not started yet.
    pub fn new(config: &Config) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_gps_dr_init(s, config) }).map(Self)
    }

    /// `dt` \[s\] have passed: their mean yaw rate, clockwise \[rad/s\], and the distance counted in them \[m\].
    pub fn step(&mut self, dt: Real, yaw_rate: Real, distance: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_dr_step(&mut self.0, dt, yaw_rate, distance) })
    }

    /// Each second, valid or not. [`Error::Gate`]: gross, or its course was.
    pub fn fix(&mut self, fix: &Fix) -> Result<(), Error> {
        // SAFETY: both are valid.
        done(unsafe { sys::ins_gps_dr_fix(&mut self.0, fix) })
    }

    /// What the state rests on.
    pub fn source(&self) -> Source {
        // SAFETY: the state is initialised.
        match unsafe { sys::ins_gps_dr_source(&self.0) } as u32 {
            sys::INS_GPS_DR_GPS => Source::Gps,
            sys::INS_GPS_DR_DR => Source::Dr,
            sys::INS_GPS_DR_ALIGN => Source::Align,
            _ => Source::None,
        }
    }

    /// East, north \[m\], heading \[rad\], speed \[m/s\], gyro bias \[rad/s\], odometer scale; their covariance, 6 by 6.
    /// [`Error::State`]: no fix yet.
    pub fn state(&self) -> Result<([Real; 6], [Real; 36]), Error> {
        let (mut x, mut p) = ([0.0; 6], [0.0; 36]);
        // SAFETY: 6 and 36 numbers out.
        done(unsafe { sys::ins_gps_dr_state(&self.0, x.as_mut_ptr(), p.as_mut_ptr()) })?;
        Ok((x, p))
    }

    /// Of the last fix.
    pub fn nis(&self) -> Real {
        self.0.nis
    }
}
