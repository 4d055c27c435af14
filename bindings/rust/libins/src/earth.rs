//! The WGS-84 Earth under a navigator: radii of curvature, normal gravity, rates. Frame: n (NED). SI.
//!
//! Latitude comes as its sine and cosine. Source: NIMA TR8350.2, 3rd ed., 2000.
//! SPDX-License-Identifier: MIT
use crate::status::fill;
use crate::{sys, Real, Vec3};

/// Earth rate \[rad/s\].
pub const RATE: Real = sys::INS_EARTH_RATE;

/// Radii of curvature of the meridian and of the prime vertical \[m\].
pub fn radii(sin_lat: Real) -> [Real; 2] {
    // SAFETY: 2 numbers out.
    fill(|out| unsafe { sys::ins_earth_radii(sin_lat, out) })
}

/// Normal gravity at a height, positive down, centrifugal acceleration included \[m/s^2\].
pub fn gravity(sin_lat: Real, height: Real) -> Real {
    // SAFETY: no memory is passed.
    unsafe { sys::ins_earth_gravity(sin_lat, height) }
}

/// Earth against inertial space, w_ie_n \[rad/s\].
pub fn rate(sin_lat: Real, cos_lat: Real) -> Vec3 {
    // SAFETY: 3 numbers out.
    fill(|out| unsafe { sys::ins_earth_rate(sin_lat, cos_lat, out) })
}

/// Navigation frame against Earth, w_en_n \[rad/s\]; `cos_lat` not 0.
pub fn transport_rate(sin_lat: Real, cos_lat: Real, height: Real, v_n: &Vec3) -> Vec3 {
    // SAFETY: 3 numbers each.
    fill(|out| unsafe { sys::ins_earth_transport_rate(sin_lat, cos_lat, height, v_n.as_ptr(), out) })
}
