//! NMEA 0183 sentences GGA, RMC and VTG of any talker, octet by octet, in integers. docs/nmea.md.
//! SPDX-License-Identifier: MIT
use crate::sys;

/// Which sentence.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sentence {
    /// Fix.
    Gga,
    /// Minimum.
    Rmc,
    /// Track and speed.
    Vtg,
}

/// What was in the sentence; none for an empty field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fix {
    /// Which sentence.
    pub sentence: Sentence,
    /// GGA: quality above 0; RMC: A; VTG: mode is not N.
    pub valid: bool,
    /// GGA: 0 none, 1 GPS, 2 differential, 4 fixed, 5 float; otherwise 0.
    pub quality: u8,
    /// Since midnight UTC \[ms\].
    pub time_ms: Option<u32>,
    /// Day, month, year of the century.
    pub date: Option<[u8; 3]>,
    /// Latitude and longitude \[1e-7 deg\], north and east positive.
    pub position: Option<(i32, i32)>,
    /// Satellites in use.
    pub sats: Option<u8>,
    /// Horizontal dilution \[1e-3\].
    pub hdop_milli: Option<i32>,
    /// Above mean sea level \[mm\].
    pub altitude_mm: Option<i32>,
    /// Mean sea level above the ellipsoid \[mm\].
    pub geoid_mm: Option<i32>,
    /// \[1e-3 knot\], 1 knot = 1852/3600 m/s.
    pub speed_milliknot: Option<i32>,
    /// From true north, clockwise \[1e-3 deg\].
    pub course_mdeg: Option<i32>,
}

/// Sentences and why others were not given out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counters {
    /// Given out.
    pub taken: u32,
    /// Checksum wrong, or none.
    pub bad_checksum: u32,
    /// Checksum right, but a field cannot be read.
    pub malformed: u32,
    /// Stopped, too long, or no text.
    pub cut: u32,
    /// Right, but none of the three.
    pub other: u32,
}

/// The parser.
#[derive(Clone, Copy, Debug)]
pub struct Parser(sys::ins_nmea_t);

impl Default for Parser {
    fn default() -> Self {
        let mut raw = sys::ins_nmea_t::default();
        // SAFETY: the state is a valid place.
        unsafe { sys::ins_nmea_init(&mut raw) }
        Self(raw)
    }
}

impl Parser {
    /// An octet came.
    pub fn rx(&mut self, octet: u8) -> Option<Fix> {
        // SAFETY: the state is initialised.
        match unsafe { sys::ins_nmea_rx(&mut self.0, octet) } as u32 {
            sys::INS_NMEA_GGA => Some(self.fix(Sentence::Gga)),
            sys::INS_NMEA_RMC => Some(self.fix(Sentence::Rmc)),
            sys::INS_NMEA_VTG => Some(self.fix(Sentence::Vtg)),
            _ => None,
        }
    }

    fn fix(&self, sentence: Sentence) -> Fix {
        let f = &self.0.fix;
        let has = |bit: u32| u32::from(f.has) & bit != 0;
        Fix {
            sentence,
            valid: f.valid != 0,
            quality: f.quality,
            time_ms: has(sys::INS_NMEA_TIME).then_some(f.time_ms),
            date: has(sys::INS_NMEA_DATE).then_some(f.date),
            position: has(sys::INS_NMEA_POSITION).then_some((f.lat_e7, f.lon_e7)),
            sats: has(sys::INS_NMEA_SATS).then_some(f.sats),
            hdop_milli: has(sys::INS_NMEA_HDOP).then_some(f.hdop_milli),
            altitude_mm: has(sys::INS_NMEA_ALTITUDE).then_some(f.altitude_mm),
            geoid_mm: has(sys::INS_NMEA_GEOID).then_some(f.geoid_mm),
            speed_milliknot: has(sys::INS_NMEA_SPEED).then_some(f.speed_milliknot),
            course_mdeg: has(sys::INS_NMEA_COURSE).then_some(f.course_mdeg),
        }
    }

    /// Counters.
    pub fn counters(&self) -> Counters {
        let raw = &self.0;
        Counters { taken: raw.taken, bad_checksum: raw.bad_checksum, malformed: raw.malformed, cut: raw.cut, other: raw.other }
    }
}
