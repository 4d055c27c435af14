//! GPS/INS: a strapdown corrected by a filter of its 15 errors, or of 21 with scale factors. Frames: b, n (NED). SI, rad.
//!
//! Late fixes, lever arm, rest, wheels, odometer, yaw rate, height; what is refused is counted. Source: Groves 2013; docs/gps_ins.md.
//!
//! ```
//! use libins::gps_ins::{config, Fix, GpsIns, Start};
//! use libins::{sculling::Increment, strapdown::Position};
//! # fn main() -> Result<(), libins::Error> {
//! let home = Position { anchor: [0.8, 0.2, 100.0], offset: [0.0; 3] };
//! let start = Start { q_nb: [1.0, 0.0, 0.0, 0.0], position: home, sigma: [0.01; 15], ..Start::default() };
//! let mut nav = GpsIns::new(&config(), &start)?;
//! let fix = Fix { t_ns: 1_000_000_000, position: home, sigma_p: [2.0; 3], sigma_v: [0.1; 3], ..Fix::default() };
//! for k in 1..=100 {
//!     let rest = Increment { theta_b: [0.0; 3], v_b: [0.0, 0.0, -0.0981] }; // your IMU
//!     nav.step(k * 10_000_000, 0.01, &rest)?;
//! }
//! nav.gnss(&fix)?;
//! assert_eq!(nav.count().fixes, 1);
//! assert!(nav.state().sigma[6] < 0.1);
//! # Ok(())
//! # }
//! ```
//! SPDX-License-Identifier: MIT
use crate::kf15::ScaleSensors;
use crate::sculling::Increment;
use crate::status::{done, init};
use crate::{sys, Error, Real, Vec3};

/// Noise, limits, gates, lever arms.
pub type Config = sys::ins_gps_ins_config_t;
/// Time, attitude, velocity, position, biases and the standard deviation of each.
pub type Start = sys::ins_gps_ins_start_t;
/// Position and velocity of the antenna; a standard deviation of 0: that component is not known.
pub type Fix = sys::ins_gnss_fix_t;
/// The answer with its covariance.
pub type State = sys::ins_gps_ins_state_t;
/// What was used and refused.
pub type Count = sys::ins_gps_ins_count_t;
/// The last fix beside the filter: innovations and NIS.
pub type Check = sys::ins_gps_ins_check_t;

/// A low-cost MEMS IMU.
pub fn config() -> Config {
    let mut config = Config::default();
    // SAFETY: a valid place.
    unsafe { sys::ins_gps_ins_config(&mut config) }
    config
}

mod form {
    use super::sys;

    /// What begins with the filter of 15 states.
    pub trait Form: Default {
        fn base(&self) -> &sys::ins_gps_ins_t;
        fn base_mut(&mut self) -> *mut sys::ins_gps_ins_t;
    }

    impl Form for sys::ins_gps_ins_t {
        fn base(&self) -> &sys::ins_gps_ins_t {
            self
        }
        fn base_mut(&mut self) -> *mut sys::ins_gps_ins_t {
            self
        }
    }

    impl Form for sys::ins_gps_ins_ud_t {
        fn base(&self) -> &sys::ins_gps_ins_t {
            &self.base
        }
        fn base_mut(&mut self) -> *mut sys::ins_gps_ins_t {
            core::ptr::from_mut(self).cast() // of all of it: the C functions reach beyond the base
        }
    }

    impl Form for sys::ins_gps_ins_scale_t {
        fn base(&self) -> &sys::ins_gps_ins_t {
            &self.base
        }
        fn base_mut(&mut self) -> *mut sys::ins_gps_ins_t {
            core::ptr::from_mut(self).cast()
        }
    }
}
use form::Form;

/// One of the forms: [`GpsIns`], [`GpsInsUd`], [`GpsInsScale`].
#[derive(Clone, Copy, Debug)]
pub struct Navigator<F>(F);

/// P, symmetric.
pub type GpsIns = Navigator<sys::ins_gps_ins_t>;
/// P = U D U', for float at any P0/R.
pub type GpsInsUd = Navigator<sys::ins_gps_ins_ud_t>;
/// With scale factors of gyros and accelerometers.
pub type GpsInsScale = Navigator<sys::ins_gps_ins_scale_t>;

impl GpsIns {
    /// Begins where `start` says.
    pub fn new(config: &Config, start: &Start) -> Result<Self, Error> {
        // SAFETY: all are valid.
        init(|s| unsafe { sys::ins_gps_ins_init(s, config, start) }).map(Self)
    }
}

impl GpsInsUd {
    /// As [`GpsIns::new`].
    pub fn new(config: &Config, start: &Start) -> Result<Self, Error> {
        // SAFETY: all are valid.
        init(|s| unsafe { sys::ins_gps_ins_ud_init(s, config, start) }).map(Self)
    }
}

impl GpsInsScale {
    /// As [`GpsIns::new`]; scale factors begin at 0.
    pub fn new(config: &Config, sensors: &ScaleSensors, start: &Start) -> Result<Self, Error> {
        // SAFETY: all are valid.
        init(|s| unsafe { sys::ins_gps_ins_scale_init(s, config, sensors, start) }).map(Self)
    }

    /// Of the gyros: 0.01 reads a hundredth too much.
    pub fn gyro(&self) -> &Vec3 {
        &self.0.gyro
    }

    /// Of the accelerometers.
    pub fn accel(&self) -> &Vec3 {
        &self.0.accel
    }
}

#[allow(private_bounds)]
impl<F: Form> Navigator<F> {
    /// Next IMU sample, which ended at `t_ns` and lasted `dt` \[s\]. [`Error::State`]: lost after a gap, start again.
    pub fn step(&mut self, t_ns: i64, dt: Real, increment: &Increment) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_step(self.0.base_mut(), t_ns, dt, increment) })
    }

    /// A fix, up to half a second late. [`Error::Gate`]: neither position nor velocity was used.
    pub fn gnss(&mut self, fix: &Fix) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_gnss(self.0.base_mut(), fix) })
    }

    /// At rest now.
    pub fn zupt(&mut self) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_zupt(self.0.base_mut()) })
    }

    /// Not turning; the mean rate as the IMU gave it \[rad/s\].
    pub fn zaru(&mut self, w_ib_b: &Vec3) -> Result<(), Error> {
        // SAFETY: 3 numbers.
        done(unsafe { sys::ins_gps_ins_zaru(self.0.base_mut(), w_ib_b.as_ptr()) })
    }

    /// No velocity across the wheels.
    pub fn nhc(&mut self) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_nhc(self.0.base_mut()) })
    }

    /// Forward speed of the wheels, and its standard deviation \[m/s\].
    pub fn odometer(&mut self, speed: Real, sigma: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_odometer(self.0.base_mut(), speed, sigma) })
    }

    /// Rate of heading of another gyro, right turn positive \[rad/s\].
    pub fn yaw_rate(&mut self, rate: Real, sigma: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_yaw_rate(self.0.base_mut(), rate, sigma) })
    }

    /// Height of the IMU above the ellipsoid \[m\].
    pub fn altitude(&mut self, height: Real, sigma: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gps_ins_altitude(self.0.base_mut(), height, sigma) })
    }

    /// The answer and how sure it is.
    pub fn state(&self) -> State {
        let mut state = State::default();
        // SAFETY: the whole form is behind the pointer, which C reads only.
        unsafe { sys::ins_gps_ins_state(core::ptr::from_ref(&self.0).cast(), &mut state) }
        state
    }

    /// What was used and refused.
    pub fn count(&self) -> &Count {
        &self.0.base().count
    }

    /// The last fix beside the filter.
    pub fn check(&self) -> &Check {
        &self.0.base().check
    }
}
