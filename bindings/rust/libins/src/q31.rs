//! Attitude from angle increments in integers, for targets without an FPU. Frame: b -> n. Unit: rad in Q31, 1 rad is `1 << 31`.
//!
//! [`crate::coning::Form::Hist2Opt`] with renormalisation, the same bits everywhere. Quaternions are Q30: 1 is [`ONE`]. docs/q31.md.
//! SPDX-License-Identifier: MIT
use crate::status::{init, order};
use crate::{sys, Error, Order};

/// 1.0 of a quaternion.
pub const ONE: i32 = sys::INS_Q31_ONE;

/// Attitude in 32 bits.
#[derive(Clone, Copy, Debug)]
pub struct Q31(sys::ins_q31_t);

impl Q31 {
    /// `q_nb`: Q30, its norm within 1e-3 of 1; it is normalised.
    pub fn new(q_nb: &[i32; 4]) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_q31_init(s, q_nb.as_ptr()) }).map(Self)
    }

    /// One increment, Q31, of at most 0.5 rad.
    pub fn step(&mut self, dtheta_b: &[i32; 3]) -> Result<Order, Error> {
        // SAFETY: 3 numbers.
        order(unsafe { sys::ins_q31_step(&mut self.0, dtheta_b.as_ptr()) })
    }

    /// The attitude, Q30.
    pub fn q_nb(&self) -> &[i32; 4] {
        &self.0.q_nb
    }
}

/// Attitude in 64 bits: a quarter of the error.
#[derive(Clone, Copy, Debug)]
pub struct Q31w(sys::ins_q31w_t);

impl Q31w {
    /// As [`Q31::new`].
    pub fn new(q_nb: &[i32; 4]) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_q31w_init(s, q_nb.as_ptr()) }).map(Self)
    }

    /// As [`Q31::step`].
    pub fn step(&mut self, dtheta_b: &[i32; 3]) -> Result<Order, Error> {
        // SAFETY: 3 numbers.
        order(unsafe { sys::ins_q31w_step(&mut self.0, dtheta_b.as_ptr()) })
    }

    /// The attitude, Q30, rounded.
    pub fn q_nb(&self) -> [i32; 4] {
        let mut out = [0; 4];
        // SAFETY: 4 numbers.
        unsafe { sys::ins_q31w_get(&self.0, out.as_mut_ptr()) }
        out
    }
}
