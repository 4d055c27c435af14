//! Attitude by functional iteration on a fitted rate polynomial, from increments or sampled rates. Frame: b -> n. Unit: rad.
//!
//! For slow sampling and large manoeuvres. Source: Wu, RodFIter, IEEE Trans. AES 54(5), 2018; docs/fiter.md.
//! SPDX-License-Identifier: MIT
use crate::status::{get, init, order, same_length};
use crate::{sys, Error, Order, Quat, Real, Vec3};

/// What the polynomial goes through.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Form {
    /// The last increment alone.
    Hist0 = sys::INS_FITER_HIST0 as i32,
    /// And one before.
    Hist1 = sys::INS_FITER_HIST1 as i32,
    /// And two before.
    Hist2 = sys::INS_FITER_HIST2 as i32,
    /// And three before: the default for slow sampling.
    Hist3 = sys::INS_FITER_HIST3 as i32,
    /// And four before.
    Hist4 = sys::INS_FITER_HIST4 as i32,
    /// The last two samples of the rate.
    Rate2 = sys::INS_FITER_RATE2 as i32,
    /// Three.
    Rate3 = sys::INS_FITER_RATE3 as i32,
    /// Four.
    Rate4 = sys::INS_FITER_RATE4 as i32,
    /// Five.
    Rate5 = sys::INS_FITER_RATE5 as i32,
    /// Three increments, solved for all of them ([`turn`] only).
    Block3 = sys::INS_FITER_BLOCK3 as i32,
}

impl Form {
    /// Samples the form reads, 1 to 5.
    pub fn samples(self) -> usize {
        // SAFETY: no memory is passed.
        unsafe { sys::ins_fiter_samples(self as i32) as usize }
    }
}

/// Rotation over the form's interval from [`Form::samples`] increments, or rates times the period, oldest first \[rad\].
pub fn turn(form: Form, theta_b: &[Vec3]) -> Result<Quat, Error> {
    same_length(theta_b.len(), form.samples())?;
    // SAFETY: as many samples as the form reads, 3 numbers each, contiguous.
    get(|out| unsafe { sys::ins_fiter_turn(form as i32, theta_b.as_ptr().cast(), out) })
}

/// Attitude and the previous samples.
#[derive(Clone, Copy, Debug)]
pub struct Fiter(sys::ins_fiter_t);

impl Fiter {
    /// `period_s` is read by the rate forms alone.
    pub fn new(form: Form, period_s: Real, q_nb: &Quat) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_fiter_init(s, form as i32, period_s, q_nb.as_ptr()) }).map(Self)
    }

    /// Next increment \[rad\], or next sample of the rate \[rad/s\], the first of which turns nothing.
    pub fn step(&mut self, sample_b: &Vec3) -> Result<Order, Error> {
        // SAFETY: 3 numbers.
        order(unsafe { sys::ins_fiter_step(&mut self.0, sample_b.as_ptr()) })
    }

    /// The attitude.
    pub fn q_nb(&self) -> &Quat {
        &self.0.q_nb
    }

    /// Puts the attitude; the previous samples stay.
    pub fn set_q_nb(&mut self, q_nb: &Quat) {
        self.0.q_nb = *q_nb;
    }
}
