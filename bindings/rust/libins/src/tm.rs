//! Transverse Mercator by the Krueger series, and TM2 of TWD97. Units: rad, m.
//!
//! 1e-8 m within 10 degrees of the central meridian in double, 2 m in float. Source: Krueger 1912, Karney 2011.
//! SPDX-License-Identifier: MIT
use crate::geodesy::Ellipsoid;
use crate::status::{get, init};
use crate::{sys, Error, Real};

/// One projection.
#[derive(Clone, Copy, Debug)]
pub struct Tm(sys::ins_tm_t);

/// The TWD97 zone of a longitude \[rad\]: 121, or 119, if it is in one.
pub fn twd97_zone(lon: Real) -> Option<i32> {
    // SAFETY: no memory is passed.
    Some(unsafe { sys::ins_twd97_zone(lon) }).filter(|zone| *zone != 0)
}

impl Tm {
    /// Central meridian `lon0` \[rad\], its scale `k0`, and the false origin `[easting, northing]` \[m\].
    pub fn new(ellipsoid: &Ellipsoid, lon0: Real, k0: Real, false_origin: [Real; 2]) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_tm_init(s, ellipsoid, lon0, k0, false_origin[0], false_origin[1]) }).map(Self)
    }

    /// TM2 of TWD97, zone 121 (EPSG:3826) or 119 (EPSG:3825).
    pub fn twd97(zone: i32) -> Result<Self, Error> {
        // SAFETY: the state is a valid place.
        init(|s| unsafe { sys::ins_tm_init_twd97(s, zone) }).map(Self)
    }

    /// `[easting, northing]` \[m\] and the convergence: the bearing of grid north from true north, clockwise \[rad\].
    pub fn forward(&self, lat: Real, lon: Real) -> Result<([Real; 2], Real), Error> {
        let mut convergence = 0.0;
        // SAFETY: 2 numbers and 1 out.
        let en = get(|out| unsafe { sys::ins_tm_forward(&self.0, lat, lon, out, &mut convergence) })?;
        Ok((en, convergence))
    }

    /// `[latitude, longitude]` \[rad\].
    pub fn inverse(&self, en: &[Real; 2]) -> Result<[Real; 2], Error> {
        // SAFETY: 2 numbers each.
        get(|out| unsafe { sys::ins_tm_inverse(&self.0, en.as_ptr(), out) })
    }

    /// Forward by the corrected series of the 2009 thesis, for comparison with its results: within 1.3 degrees 1e-7 m.
    pub fn thesis_forward(&self, lat: Real, lon: Real) -> Result<[Real; 2], Error> {
        // SAFETY: 2 numbers out.
        get(|out| unsafe { sys::ins_tm_thesis_forward(&self.0, lat, lon, out) })
    }

    /// Inverse by the same: 1e-4 m.
    pub fn thesis_inverse(&self, en: &[Real; 2]) -> Result<[Real; 2], Error> {
        // SAFETY: 2 numbers each.
        get(|out| unsafe { sys::ins_tm_thesis_inverse(&self.0, en.as_ptr(), out) })
    }
}
