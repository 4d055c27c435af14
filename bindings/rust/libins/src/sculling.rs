//! Velocity increments with sculling correction, beside the attitude step. Frames: b -> n. Units: rad, m/s.
//!
//! Inputs are the integrals of rate and specific force over the interval, in the moving body frame. Source: Roscoe 2001 (duality).
//! SPDX-License-Identifier: MIT
use crate::coning::Form;
use crate::status::{get, init, same_length, step};
use crate::{sys, Error, Order, Quat, Vec3};

/// What an IMU gives for one interval: `theta_b` \[rad\] and `v_b` \[m/s\].
pub type Increment = sys::ins_increment_t;

/// Attitude and the previous increments.
#[derive(Clone, Copy, Debug)]
pub struct Sculling(sys::ins_sculling_t);

impl Sculling {
    /// As [`crate::attitude::Attitude::new`].
    pub fn new(form: Form, q_nb: &Quat) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_sculling_init(s, form as i32, q_nb.as_ptr()) }).map(Self)
    }

    /// Next interval; gives the specific force integrated in b as it stood at the interval's start \[m/s\].
    pub fn step(&mut self, increment: &Increment) -> Result<(Vec3, Order), Error> {
        // SAFETY: 3 numbers out.
        step(|out| unsafe { sys::ins_sculling_step(&mut self.0, increment, out) })
    }

    /// The attitude at the end of the last interval.
    pub fn q_nb(&self) -> &Quat {
        &self.0.q_nb
    }
}

/// The correction alone, from [`Form::samples`] increments, oldest first.
pub fn dv(form: Form, increments: &[Increment]) -> Result<Vec3, Error> {
    same_length(increments.len(), form.samples())?;
    // SAFETY: as many increments as the form reads; 3 numbers out.
    get(|out| unsafe { sys::ins_sculling_dv(form as i32, increments.as_ptr(), out) })
}
