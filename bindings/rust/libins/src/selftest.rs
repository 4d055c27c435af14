//! Known-answer self-test of the attitude path, for a firmware's start: some 60 steps, no libm. docs/selftest.md.
//! SPDX-License-Identifier: MIT
use crate::sys;

/// What failed; nothing if all are false.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Failed {
    /// Declarations and core differ.
    pub abi: bool,
    /// A coefficient sum of a coning form.
    pub coning: bool,
    /// The attitude step over one turn of a cone: its drift, its norm.
    pub step: bool,
    /// Functional iteration over the same cone.
    pub fiter: bool,
    /// Adams-Moulton weights.
    pub rates: bool,
    /// The fixed-point path over the same cone.
    pub fixed: bool,
}

/// Refuse to fly unless this is `Ok`.
pub fn selftest() -> Result<(), Failed> {
    // SAFETY: no memory is passed.
    match unsafe { sys::ins_selftest() } {
        0 => Ok(()),
        failed => Err(Failed::from_bits(failed)),
    }
}

impl Failed {
    fn from_bits(bits: u32) -> Self {
        Failed {
            abi: bits & sys::INS_SELFTEST_ABI != 0,
            coning: bits & sys::INS_SELFTEST_CONING != 0,
            step: bits & sys::INS_SELFTEST_STEP != 0,
            fiter: bits & sys::INS_SELFTEST_FITER != 0,
            rates: bits & sys::INS_SELFTEST_RATES != 0,
            fixed: bits & sys::INS_SELFTEST_FIXED != 0,
        }
    }
}
