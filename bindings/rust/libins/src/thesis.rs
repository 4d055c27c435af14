//! Attitude as in the 2009 thesis on the GPS-enabled IMU: second-order update, RK4 with norm feedback, ZXZ angles. Frame: b -> n.
//!
//! For comparison with the thesis; [`crate::attitude`] is more accurate for less work. What differs from the print: docs/thesis.md.
//! SPDX-License-Identifier: MIT
use crate::status::{fill, init, order};
use crate::{sys, Error, Mat3, Order, Quat, Real, Vec3};

/// Quaternion of one interval from its increment and the one before \[rad\], (2-15) to (2-19), not normalised.
pub fn p(theta_b: &Vec3, prev_b: &Vec3) -> Quat {
    // SAFETY: 3 numbers in each, 4 out.
    fill(|out| unsafe { sys::ins_thesis_p(theta_b.as_ptr(), prev_b.as_ptr(), out) })
}

/// Passive rotation Rz(gamma) Rx(beta) Rz(alpha) of 2.8, from alpha, beta, gamma \[rad\].
pub fn zxz(angles: &Vec3) -> Mat3 {
    // SAFETY: 3 numbers in, 9 out.
    fill(|out| unsafe { sys::ins_thesis_zxz(angles.as_ptr(), out) })
}

/// The second-order update.
#[derive(Clone, Copy, Debug)]
pub struct Thesis(sys::ins_thesis_t);

impl Thesis {
    /// `q_nb`: its norm within 1e-3 of 1; it is normalised.
    pub fn new(q_nb: &Quat) -> Result<Self, Error> {
        // SAFETY: 4 numbers.
        init(|s| unsafe { sys::ins_thesis_init(s, q_nb.as_ptr()) }).map(Self)
    }

    /// One increment, |component| <= 1 rad.
    pub fn step(&mut self, dtheta_b: &Vec3) -> Result<Order, Error> {
        // SAFETY: 3 numbers.
        order(unsafe { sys::ins_thesis_step(&mut self.0, dtheta_b.as_ptr()) })
    }

    /// The attitude.
    pub fn q_nb(&self) -> &Quat {
        &self.0.q_nb
    }

    /// Puts the attitude; the previous increment stays.
    pub fn set_q_nb(&mut self, q_nb: &Quat) {
        self.0.q_nb = *q_nb;
    }
}

/// Runge-Kutta of fourth order on q' = q w / 2 + k (1 - |q|^2) q.
#[derive(Clone, Copy, Debug)]
pub struct Rk4(sys::ins_thesis_rk4_t);

impl Rk4 {
    /// `feedback` k >= 0 \[1/s\] and `step_s` h > 0 with 2 k h below the stability limit 2.785; `w_ib_b` the rate at the start \[rad/s\].
    pub fn new(feedback: Real, step_s: Real, q_nb: &Quat, w_ib_b: &Vec3) -> Result<Self, Error> {
        // SAFETY: 4 and 3 numbers.
        init(|s| unsafe { sys::ins_thesis_rk4_init(s, feedback, step_s, q_nb.as_ptr(), w_ib_b.as_ptr()) }).map(Self)
    }

    /// One step of h, from the rates in its middle and at its end \[rad/s\].
    pub fn step(&mut self, w_mid_b: &Vec3, w_end_b: &Vec3) -> Result<Order, Error> {
        // SAFETY: 3 numbers each.
        order(unsafe { sys::ins_thesis_rk4_step(&mut self.0, w_mid_b.as_ptr(), w_end_b.as_ptr()) })
    }

    /// The attitude; with k = 0 its norm is the caller's.
    pub fn q_nb(&self) -> &Quat {
        &self.0.q_nb
    }

    /// Puts the attitude, say normalised.
    pub fn set_q_nb(&mut self, q_nb: &Quat) {
        self.0.q_nb = *q_nb;
    }
}
