//! Attitude, velocity and position from increments, over the WGS-84 Earth. Frames: b -> n (NED). Units: SI, rad.
//!
//! Second order in the period; not within 6.4 km of a pole. Source: Savage 1998, NIMA TR8350.2; docs/strapdown.md.
//! SPDX-License-Identifier: MIT
use crate::coning::Form;
use crate::sculling::Increment;
use crate::status::{fill, init, order};
use crate::{sys, Error, Order, Quat, Real, Vec3};

/// Latitude, longitude \[rad\], height above WGS-84 \[m\]: the sum of `anchor` and a small `offset`, fine even in float.
pub type Position = sys::ins_position_t;

/// The whole navigation state.
#[derive(Clone, Copy, Debug)]
pub struct Strapdown(sys::ins_strapdown_t);

impl Strapdown {
    /// `period_s` in (0, 1\]; `v_n` of at most 1e4 m/s; `form` no block form.
    pub fn new(form: Form, period_s: Real, q_nb: &Quat, v_n: &Vec3, position: &Position) -> Result<Self, Error> {
        // SAFETY: 4 and 3 numbers.
        init(|s| unsafe { sys::ins_strapdown_init(s, form as i32, period_s, q_nb.as_ptr(), v_n.as_ptr(), position) }).map(Self)
    }

    /// Next interval.
    pub fn step(&mut self, increment: &Increment) -> Result<Order, Error> {
        // SAFETY: both are valid.
        order(unsafe { sys::ins_strapdown_step(&mut self.0, increment) })
    }

    pub(crate) fn raw(&self) -> &sys::ins_strapdown_t {
        &self.0
    }

    /// The attitude.
    pub fn q_nb(&self) -> &Quat {
        &self.0.sculling.q_nb
    }

    /// Velocity over ground \[m/s\].
    pub fn v_n(&self) -> &Vec3 {
        &self.0.v_n
    }

    /// Where the IMU is.
    pub fn position(&self) -> &Position {
        &self.0.position
    }

    /// Velocity over ground and position of another point of the body, `l_b` from the IMU \[m\], at the angular rate `w_ib_b` \[rad/s\].
    pub fn point(&self, l_b: &Vec3, w_ib_b: &Vec3) -> (Vec3, Position) {
        let mut position = Position::default();
        // SAFETY: 3 numbers each.
        let v_n = fill(|out| unsafe { sys::ins_strapdown_point(&self.0, l_b.as_ptr(), w_ib_b.as_ptr(), out, &mut position) });
        (v_n, position)
    }
}

/// From a to b along the meridian and the parallel through a, and down \[m\].
pub fn difference(a: &Position, b: &Position) -> Vec3 {
    // SAFETY: 3 numbers out.
    fill(|out| unsafe { sys::ins_position_difference(a, b, out) })
}
