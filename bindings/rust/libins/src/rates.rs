//! Point-sampled angular rates to angle increments (an ADC gives samples, not integrals). Frame: b. Units: rad/s, rad.
//!
//! In this order: [`Skew`] brings the channels of one scan to one instant, [`Rates`] integrates with an Adams-Moulton formula.
//! Source: Hairer, Norsett, Wanner, Solving ODEs I, III.1; docs/rates.md.
//! SPDX-License-Identifier: MIT
use crate::status::{init, step};
use crate::{sys, Error, Order, Real, Vec3};

/// Integrator over one sampling period.
#[derive(Clone, Copy, Debug)]
pub struct Rates(sys::ins_rates_t);

impl Rates {
    /// `order`: 2 trapezoid, 3 to 5 Adams-Moulton. `period_s` > 0.
    pub fn new(order: u8, period_s: Real) -> Result<Self, Error> {
        // SAFETY: the state is a valid place.
        init(|s| unsafe { sys::ins_rates_init(s, order, period_s) }).map(Self)
    }

    /// Next sample \[rad/s\]; gives the increment over the last period \[rad\], zero for the very first.
    pub fn add(&mut self, w_ib_b: &Vec3) -> Result<(Vec3, Order), Error> {
        // SAFETY: 3 numbers each.
        step(|out| unsafe { sys::ins_rates_add(&mut self.0, w_ib_b.as_ptr(), out) })
    }

    /// Next sample after `missing` lost ones (at least 1): a trapezoid over the gap; the history restarts.
    pub fn bridge(&mut self, missing: u32, w_ib_b: &Vec3) -> Result<(Vec3, Order), Error> {
        // SAFETY: 3 numbers each.
        step(|out| unsafe { sys::ins_rates_bridge(&mut self.0, missing, w_ib_b.as_ptr(), out) })
    }
}

/// Channel-skew compensation by a polynomial through the last samples.
#[derive(Clone, Copy, Debug)]
pub struct Skew(sys::ins_skew_t);

impl Skew {
    /// `order` 1 to 3; channel i is sampled `delay_s[i]` after the scan's instant, 0 <= delay < period.
    pub fn new(order: u8, delay_s: &Vec3, period_s: Real) -> Result<Self, Error> {
        // SAFETY: 3 numbers.
        init(|s| unsafe { sys::ins_skew_init(s, order, delay_s.as_ptr(), period_s) }).map(Self)
    }

    /// A scan as sampled to the same at its instant.
    pub fn add(&mut self, raw: &Vec3) -> Result<(Vec3, Order), Error> {
        // SAFETY: 3 numbers each.
        step(|out| unsafe { sys::ins_skew_add(&mut self.0, raw.as_ptr(), out) })
    }

    /// After lost samples: keep only what comes next.
    pub fn restart(&mut self) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_skew_restart(&mut self.0) }
    }
}
