//! Attitude from angle increments by the default formula alone, for small flash. Frame: b -> n. Unit: rad.
//!
//! The bits of [`crate::attitude::Attitude`] with [`crate::coning::Form::Hist2Opt`], start-up included, up to 0.5 rad a step.
//! SPDX-License-Identifier: MIT
use crate::status::{init, order};
use crate::{sys, Error, Order, Quat, Vec3};

/// Attitude and the two previous increments.
#[derive(Clone, Copy, Debug)]
pub struct Hist2(sys::ins_hist2_t);

impl Hist2 {
    /// `q_nb`: its norm within 1e-3 of 1; it is normalised.
    pub fn new(q_nb: &Quat) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_hist2_init(s, q_nb.as_ptr()) }).map(Self)
    }

    /// Add one increment \[rad\], of at most 0.5 with its coning term.
    pub fn step(&mut self, dtheta_b: &Vec3) -> Result<Order, Error> {
        // SAFETY: 3 numbers.
        order(unsafe { sys::ins_hist2_step(&mut self.0, dtheta_b.as_ptr()) })
    }

    /// The attitude: `v_n = q_nb v_b q_nb*`.
    pub fn q_nb(&self) -> &Quat {
        &self.0.q_nb
    }
}
