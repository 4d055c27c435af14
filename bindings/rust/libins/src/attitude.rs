//! Attitude from angle increments: rotation vector with coning correction, quaternion, renormalisation. Frame: b -> n. Unit: rad.
//!
//! One increment is one update; the start-up uses 0, 1, 2 previous increments as they come. docs/coning.md says which form to take.
//! SPDX-License-Identifier: MIT
use crate::coning::Form;
use crate::status::{done, init, order};
use crate::{sys, Error, Order, Quat, Vec3};

/// Attitude and the previous increments.
#[derive(Clone, Copy, Debug)]
pub struct Attitude(sys::ins_attitude_t);

impl Attitude {
    /// `form`: no block form. `q_nb`: its norm within 1e-3 of 1; it is normalised.
    pub fn new(form: Form, q_nb: &Quat) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_attitude_init(s, form as i32, q_nb.as_ptr()) }).map(Self)
    }

    /// Add one increment \[rad\], each component within 0.5 for the accuracy of docs/coning.md, at most pi.
    pub fn step(&mut self, dtheta_b: &Vec3) -> Result<Order, Error> {
        // SAFETY: 3 numbers.
        order(unsafe { sys::ins_attitude_step(&mut self.0, dtheta_b.as_ptr()) })
    }

    /// Turn of the navigation frame over the same time, `dzeta_n` the integral of w_in_n \[rad\]: Earth rate and transport rate.
    pub fn turn_frame(&mut self, dzeta_n: &Vec3) -> Result<(), Error> {
        // SAFETY: 3 numbers.
        done(unsafe { sys::ins_attitude_turn_frame(&mut self.0, dzeta_n.as_ptr()) })
    }

    /// Add one rotation that spans a gap \[rad\]; the history restarts.
    pub fn jump(&mut self, phi_b: &Vec3) -> Result<(), Error> {
        // SAFETY: 3 numbers.
        done(unsafe { sys::ins_attitude_jump(&mut self.0, phi_b.as_ptr()) })
    }

    /// The attitude: `v_n = q_nb v_b q_nb*`.
    pub fn q_nb(&self) -> &Quat {
        &self.0.q_nb
    }

    /// Puts the attitude, say after a fix; the previous increments stay.
    pub fn set_q_nb(&mut self, q_nb: &Quat) {
        self.0.q_nb = *q_nb;
    }
}
