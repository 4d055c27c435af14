//! Navigation without gyros: six or more accelerometers, aided by positions and standstills. Frames: b -> n (NED). SI, rad.
//!
//! Errors grow with the fourth power of time: nothing here lasts without aiding. docs/gyro_free.md.
//!
//! ```
//! use libins::{gyro_free::{Config, GyroFree}, sixacc, strapdown::Position};
//! # fn main() -> Result<(), libins::Error> {
//! let accels = sixacc::paper(0.1);
//! let home = Position { anchor: [0.8, 0.2, 100.0], offset: [0.0; 3] };
//! let config = Config { noise: 1e-3, bias: 1e-3, attitude: [0.01; 3], velocity: 0.1, position: 1.0, rate: 0.01, ..Config::default() };
//! let mut nav = GyroFree::new(&config, &accels, 0.01, &[1.0, 0.0, 0.0, 0.0], &[0.0; 3], &home)?;
//! let at_rest = accels.map(|a| -9.81 * a.axis[2]); // your readings
//! for _ in 0..100 {
//!     nav.step(&at_rest)?;
//!     nav.still(0.01, 1e-3)?;
//! }
//! assert!(nav.sigma()[3] < 0.01);
//! # Ok(())
//! # }
//! ```
//! SPDX-License-Identifier: MIT
use crate::status::{done, fill, init, order, same_length};
use crate::strapdown::Position;
use crate::{sixacc::Accel, sys, Error, Order, Quat, Real, Vec3};
use core::ffi::c_uint;

/// Errors: attitude, velocity, position, rate, and those of the angular acceleration and of the specific force.
pub const N: usize = sys::INS_GYRO_FREE_N as usize;

/// Standard deviations, and the gate.
pub type Config = sys::ins_gyro_free_config_t;

/// The navigator.
#[derive(Clone, Copy, Debug)]
pub struct GyroFree(sys::ins_gyro_free_t);

impl GyroFree {
    /// At rate 0. 6 to [`crate::sixacc::MAX`] accelerometers whose six unknowns are observable.
    pub fn new(config: &Config, accels: &[Accel], period_s: Real, q_nb: &Quat, v_n: &Vec3, position: &Position) -> Result<Self, Error> {
        let n = c_uint::try_from(accels.len()).map_err(|_| Error::Range)?;
        let (a, q, v) = (accels.as_ptr(), q_nb.as_ptr(), v_n.as_ptr());
        // SAFETY: n accelerometers, 4 and 3 numbers.
        init(|s| unsafe { sys::ins_gyro_free_init(s, config, n, a, period_s, q, v, position) }).map(Self)
    }

    /// Next sample.
    pub fn step(&mut self, readings: &[Real]) -> Result<Order, Error> {
        same_length(readings.len(), self.0.sixacc.count.into())?;
        // SAFETY: a reading of each accelerometer.
        order(unsafe { sys::ins_gyro_free_step(&mut self.0, readings.as_ptr()) })
    }

    /// Position of an antenna at `l_b` from the IMU \[m\]. [`Error::Gate`]: an axis was outside the gate, the others count.
    pub fn position_fix(&mut self, fix: &Position, sigma: &Vec3, l_b: &Vec3) -> Result<(), Error> {
        // SAFETY: 3 numbers each.
        done(unsafe { sys::ins_gyro_free_position(&mut self.0, fix, sigma.as_ptr(), l_b.as_ptr()) })
    }

    /// A known velocity \[m/s\].
    pub fn velocity(&mut self, v_n: &Vec3, sigma: &Vec3) -> Result<(), Error> {
        // SAFETY: 3 numbers each.
        done(unsafe { sys::ins_gyro_free_velocity(&mut self.0, v_n.as_ptr(), sigma.as_ptr()) })
    }

    /// Known to stand still.
    pub fn still(&mut self, sigma_v: Real, sigma_w: Real) -> Result<(), Error> {
        // SAFETY: the state is initialised.
        done(unsafe { sys::ins_gyro_free_still(&mut self.0, sigma_v, sigma_w) })
    }

    /// Standard deviations of the errors.
    pub fn sigma(&self) -> [Real; N] {
        // SAFETY: N numbers out.
        fill(|out| unsafe { sys::ins_gyro_free_sigma(&self.0, out) })
    }

    /// The attitude.
    pub fn q_nb(&self) -> &Quat {
        &self.0.strapdown.sculling.q_nb
    }

    /// Velocity over ground \[m/s\].
    pub fn v_n(&self) -> &Vec3 {
        &self.0.strapdown.v_n
    }

    /// Where the IMU is.
    pub fn position(&self) -> &Position {
        &self.0.strapdown.position
    }

    /// Rate at the last sample \[rad/s\].
    pub fn w_ib_b(&self) -> &Vec3 {
        &self.0.sixacc.w_ib_b
    }
}
