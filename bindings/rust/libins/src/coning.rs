//! Rotation vector of an interval from the gyro's angle increments, coning corrected. Frame: b. Unit: rad.
//!
//! Block forms span all their increments; history forms span the last alone and take the ones before it only to know how the rate
//! turns. FIT: exact for a rate that is a polynomial in time. OPT: least drift in coning motion. Source: Miller 1983, Savage 1998,
//! Ignagni 1990; docs/coning.md.
//! SPDX-License-Identifier: MIT
use crate::status::{get, same_length};
use crate::{sys, Error, Vec3};

/// Which increments are read, and how they are weighed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(i32)]
pub enum Form {
    /// No correction.
    One = sys::INS_CONING_ONE as i32,
    /// One increment before the interval.
    Hist1 = sys::INS_CONING_HIST1 as i32,
    /// Two before, exact for a polynomial rate.
    Hist2Fit = sys::INS_CONING_HIST2_FIT as i32,
    /// Two before, least drift in coning: the default.
    Hist2Opt = sys::INS_CONING_HIST2_OPT as i32,
    /// Three before, exact for a polynomial rate.
    Hist3Fit = sys::INS_CONING_HIST3_FIT as i32,
    /// Three before, least drift in coning.
    Hist3Opt = sys::INS_CONING_HIST3_OPT as i32,
    /// Block of two.
    Block2 = sys::INS_CONING_BLOCK2 as i32,
    /// Block of three, 33/80 and 57/80: equation 5 of Zheng and Zhou (2010).
    Block3Fit = sys::INS_CONING_BLOCK3_FIT as i32,
    /// Block of three, least drift in coning.
    Block3Opt = sys::INS_CONING_BLOCK3_OPT as i32,
    /// Block of four, exact for a polynomial rate.
    Block4Fit = sys::INS_CONING_BLOCK4_FIT as i32,
    /// Block of four, least drift in coning.
    Block4Opt = sys::INS_CONING_BLOCK4_OPT as i32,
    /// Two before, least peak drift for vibration of up to 0.3 rad of phase an increment.
    Hist2Mu03 = sys::INS_CONING_HIST2_MU03 as i32,
    /// Up to 0.6 rad.
    Hist2Mu06 = sys::INS_CONING_HIST2_MU06 as i32,
    /// Up to 1 rad.
    Hist2Mu10 = sys::INS_CONING_HIST2_MU10 as i32,
}

impl Form {
    /// Increments the form reads, 1 to 4.
    pub fn samples(self) -> usize {
        // SAFETY: no memory is passed.
        unsafe { sys::ins_coning_samples(self as i32) as usize }
    }

    /// Whether the form spans all its increments; a history form spans only the last.
    pub fn is_block(self) -> bool {
        // SAFETY: no memory is passed.
        unsafe { sys::ins_coning_is_block(self as i32) == 1 }
    }
}

/// Rotation vector of the form's interval \[rad\] from [`Form::samples`] increments, oldest first.
pub fn phi(form: Form, theta_b: &[Vec3]) -> Result<Vec3, Error> {
    same_length(theta_b.len(), form.samples())?;
    // SAFETY: as many increments as the form reads, 3 numbers each, contiguous.
    get(|out| unsafe { sys::ins_coning_phi(form as i32, theta_b.as_ptr().cast(), out) })
}
