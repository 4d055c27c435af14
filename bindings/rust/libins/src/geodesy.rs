//! Geodetic coordinates, Earth-fixed Cartesian ones, local NED and ENU. Frames: e (ECEF), n. Units: rad, m.
//!
//! `llh` is latitude, longitude, height above the ellipsoid. Double: 1e-8 m; float: steps of 0.5 m. Source: Bowring 1976, 1985.
//! SPDX-License-Identifier: MIT
use crate::status::{fill, get, init};
use crate::{sys, Error, Vec3};

/// `a` \[m\], `f`, `e2` = f (2 - f).
pub type Ellipsoid = sys::ins_ellipsoid_t;

/// WGS-84.
pub fn wgs84() -> &'static Ellipsoid {
    // SAFETY: a constant of the core.
    unsafe { &sys::ins_wgs84 }
}

/// GRS 80, of TWD97.
pub fn grs80() -> &'static Ellipsoid {
    // SAFETY: a constant of the core.
    unsafe { &sys::ins_grs80 }
}

/// ECEF \[m\] of `llh`.
pub fn to_ecef(ellipsoid: &Ellipsoid, llh: &Vec3) -> Result<Vec3, Error> {
    // SAFETY: 3 numbers each.
    get(|out| unsafe { sys::ins_geodesy_to_ecef(ellipsoid, llh.as_ptr(), out) })
}

/// `llh` of ECEF; refused nearer to the centre than a / 2.
pub fn from_ecef(ellipsoid: &Ellipsoid, xyz_e: &Vec3) -> Result<Vec3, Error> {
    // SAFETY: 3 numbers each.
    get(|out| unsafe { sys::ins_geodesy_from_ecef(ellipsoid, xyz_e.as_ptr(), out) })
}

/// NED to ENU and ENU to NED.
pub fn swap(v: &Vec3) -> Vec3 {
    // SAFETY: 3 numbers each.
    fill(|out| unsafe { sys::ins_local_swap(v.as_ptr(), out) })
}

/// A tangent frame fixed to the Earth.
#[derive(Clone, Copy, Debug)]
pub struct Local(sys::ins_local_t);

impl Local {
    /// With its origin at `llh`.
    pub fn new(ellipsoid: &Ellipsoid, llh: &Vec3) -> Result<Self, Error> {
        // SAFETY: 3 numbers.
        init(|s| unsafe { sys::ins_local_init(s, ellipsoid, llh.as_ptr()) }).map(Self)
    }

    /// NED from the origin \[m\].
    pub fn from_ecef(&self, xyz_e: &Vec3) -> Vec3 {
        // SAFETY: 3 numbers each.
        fill(|out| unsafe { sys::ins_local_from_ecef(&self.0, xyz_e.as_ptr(), out) })
    }

    /// ECEF \[m\].
    pub fn to_ecef(&self, ned: &Vec3) -> Vec3 {
        // SAFETY: 3 numbers each.
        fill(|out| unsafe { sys::ins_local_to_ecef(&self.0, ned.as_ptr(), out) })
    }
}
