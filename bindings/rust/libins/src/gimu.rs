//! Packets of the GIMU (2006 thesis, chapter 4) octet by octet, and their scaling. Frame: b. Units: rad, m/s.
//!
//! A packet is given out with the second octet of the next one, or by [`Parser::flush`]. What cannot be seen: docs/gimu.md.
//! SPDX-License-Identifier: MIT
use crate::status::fill;
use crate::{sys, Real, Vec3};

/// Packets a second.
pub const RATE_HZ: u32 = sys::INS_GIMU_RATE_HZ;

/// One packet. `raw` is P, Q, R, AX, AY, AZ \[LSB\].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Packet {
    /// 14 octets.
    T1 {
        /// Samples.
        raw: [u16; 6],
    },
    /// 23 octets.
    T2 {
        /// Samples.
        raw: [u16; 6],
        /// As sent, (d)ddmm.mmmm times 10^4.
        coordinate: [u32; 2],
        /// Latitude and longitude \[1e-7 deg\]; none where both coordinates are above 90 degrees.
        position: Option<(i32, i32)>,
        /// Satellites.
        sats: u8,
    },
}

/// The framer.
#[derive(Clone, Copy, Debug)]
pub struct Parser(sys::ins_gimu_t);

impl Parser {
    /// `check_12_bits`: a sample above FFF is no sample.
    pub fn new(check_12_bits: bool) -> Self {
        let mut raw = sys::ins_gimu_t::default();
        // SAFETY: the state is a valid place.
        unsafe { sys::ins_gimu_init(&mut raw, check_12_bits.into()) }
        Self(raw)
    }

    /// An octet came.
    pub fn rx(&mut self, octet: u8) -> Option<Packet> {
        // SAFETY: the state is initialised.
        let kind = unsafe { sys::ins_gimu_rx(&mut self.0, octet) };
        self.packet(kind as u32)
    }

    /// Nothing follows for now: judge what waits. Repeat until it gives none.
    pub fn flush(&mut self) -> Option<Packet> {
        // SAFETY: the state is initialised.
        let kind = unsafe { sys::ins_gimu_flush(&mut self.0) };
        self.packet(kind as u32)
    }

    fn packet(&self, kind: u32) -> Option<Packet> {
        let p = &self.0.packet;
        match kind {
            sys::INS_GIMU_T1 => Some(Packet::T1 { raw: p.raw }),
            sys::INS_GIMU_T2 => Some(Packet::T2 {
                raw: p.raw,
                coordinate: p.coordinate,
                position: (p.has_position != 0).then_some((p.lat_e7, p.lon_e7)),
                sats: p.sats,
            }),
            _ => None,
        }
    }

    /// Octets that belong to no packet.
    pub fn skipped(&self) -> u32 {
        self.0.skipped
    }

    /// Octets that wait for the next header.
    pub fn waiting(&self) -> usize {
        self.0.count.into()
    }
}

/// A coordinate as sent, in 1e-7 degree; none unless degrees <= 180 and minutes < 60.
pub fn e7(coordinate: u32) -> Option<i32> {
    let (degrees, minutes) = (coordinate / 1_000_000, coordinate % 1_000_000);
    // SAFETY: no memory is passed.
    (degrees <= 180 && minutes < 600_000).then(|| unsafe { sys::ins_gimu_e7(coordinate) })
}

/// `null` \[LSB\], `rate` \[rad/s per LSB\], `acceleration` \[m/s^2 per LSB\].
pub type Scale = sys::ins_gimu_scale_t;

fn scale(call: unsafe extern "C" fn(*mut Scale)) -> Scale {
    let mut raw = Scale::default();
    // SAFETY: the scale is a valid place.
    unsafe { call(&mut raw) }
    raw
}

/// The thesis's K of the gyros, the data sheet's of the accelerometers, nulls at 2047.
pub fn scale_thesis() -> Scale {
    scale(sys::ins_gimu_scale_thesis)
}

/// Data-sheet values, nulls at 2047.
pub fn scale_nominal() -> Scale {
    scale(sys::ins_gimu_scale_nominal)
}

/// Angle \[rad\] and velocity \[m/s\] increments of one packet over `dt` \[s\], 1/6 for a GIMU.
pub fn increments(scale: &Scale, raw: &[u16; 6], dt: Real) -> (Vec3, Vec3) {
    let mut dv = [0.0; 3];
    // SAFETY: 6 samples in, 3 numbers each out.
    let dtheta = fill(|out| unsafe { sys::ins_gimu_increments(scale, raw.as_ptr(), dt, out, dv.as_mut_ptr()) });
    (dtheta, dv)
}
