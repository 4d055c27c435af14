//! "Sample reuse" of Zheng and Zhou (2010), 1.2: attitude at every sample from three interleaved chains. Frame: b -> n. Unit: rad.
//!
//! For comparison with the paper; a history form of [`crate::attitude`] does the same from one start attitude.
//! SPDX-License-Identifier: MIT
use crate::coning::Form;
use crate::status::{init, step};
use crate::{sys, Error, Order, Quat, Vec3};

/// Three chains, and two increments.
#[derive(Clone, Copy, Debug)]
pub struct Reuse(sys::ins_reuse_t);

impl Reuse {
    /// `form`: [`Form::Block3Fit`] or [`Form::Block3Opt`]. `q_nb`: Q(0), Q(1), Q(2).
    pub fn new(form: Form, q_nb: &[Quat; 3]) -> Result<Self, Error> {
        // SAFETY: 12 numbers, contiguous.
        init(|s| unsafe { sys::ins_reuse_init(s, form as i32, q_nb.as_ptr().cast()) }).map(Self)
    }

    /// Increment from t(k) to t(k+1) \[rad\]; gives Q(k+1), which for the first two are those of the start.
    pub fn step(&mut self, dtheta_b: &Vec3) -> Result<(Quat, Order), Error> {
        // SAFETY: 3 numbers in, 4 out.
        step(|out| unsafe { sys::ins_reuse_step(&mut self.0, dtheta_b.as_ptr(), out) })
    }
}
