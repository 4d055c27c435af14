//! Inertial navigation for firmware and hosts: the C core of libins, safe, `no_std`, without allocation.
//!
//! Units are SI and radians; only names that end in `_deg` hold degrees. Frames: i inertial, e Earth-fixed, n navigation (north, east,
//! down), b body. `x_ab_c` is x of b relative to a, resolved in c. A quaternion `q_nb` is `[w, x, y, z]`, Hamilton, and turns body
//! vectors into navigation ones; matrices are row-major. Sources and derivations: the header of the C module and docs/ of the project.
//!
//! Each state is a plain struct: place it where you like, and a copy is a snapshot. Refused means [`Error`] and nothing changed.
//! [`Real`] is `f64`, or `f32` with the feature `float` (`default-features = false`): one of them for the whole program.
//!
//! ```
//! use libins::{attitude::Attitude, coning::Form, rates::Rates};
//! # fn main() -> Result<(), libins::Error> {
//! let mut rates = Rates::new(4, 0.02)?; // Adams-Moulton, order 4, 20 ms
//! let mut attitude = Attitude::new(Form::Hist2Opt, &[1.0, 0.0, 0.0, 0.0])?;
//! for _ in 0..500 {
//!     let (dtheta_b, _) = rates.add(&[0.1, 0.0, 0.2])?; // your gyro, rad/s
//!     attitude.step(&dtheta_b)?;
//! }
//! assert!(attitude.q_nb()[0] < 1.0);
//! # Ok(())
//! # }
//! ```
//! SPDX-License-Identifier: MIT
#![no_std]
#![warn(missing_docs, missing_debug_implementations)]

pub mod accelfit;
pub mod align;
pub mod attitude;
pub mod batch;
pub mod coning;
pub mod dead_reckoning;
pub mod earth;
pub mod fiter;
pub mod fusion;
pub mod geodesy;
pub mod gimu;
pub mod gps_axis;
pub mod gps_dr;
pub mod gps_ins;
pub mod gyro_free;
pub mod handshake;
pub mod hist2;
pub mod kalman;
pub mod kf15;
pub mod link;
pub mod markov;
pub mod nmea;
pub mod pva;
pub mod q31;
pub mod quat;
pub mod rates;
pub mod reuse;
pub mod sculling;
pub mod selftest;
pub mod sixacc;
mod status;
pub mod strapdown;
pub mod thesis;
pub mod tm;
pub mod unicycle;
pub mod version;

pub use libins_sys as sys;
pub use status::{Error, Order};

/// The number type of the library: `f64`, or `f32` with the feature `float`.
pub type Real = sys::ins_real;
/// x, y, z.
pub type Vec3 = [Real; 3];
/// w, x, y, z.
pub type Quat = [Real; 4];
/// 3 by 3, row-major.
pub type Mat3 = [Real; 9];
