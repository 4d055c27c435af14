//! Fusion of estimates of one state of N numbers, information sharing, and the switch between GPS and dead reckoning.
//!
//! Source: Carlson, IEEE Trans. AES 26(3), 1990 (information sharing); docs/gps_dr.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, init};
use crate::{sys, Error, Real};
use core::ffi::{c_int, c_uint};

/// Sum of information; estimates are taken for uncorrelated.
#[derive(Clone, Copy, Debug)]
pub struct Fusion<const N: usize> {
    info: [[Real; N]; N],
    y: [Real; N],
}

impl<const N: usize> Default for Fusion<N> {
    fn default() -> Self {
        Self { info: [[0.0; N]; N], y: [0.0; N] }
    }
}

impl<const N: usize> Fusion<N> {
    /// An estimate and its covariance, which must be positive definite.
    pub fn add(&mut self, x: &[Real; N], p: &[[Real; N]; N]) -> Result<(), Error> {
        let mut work = [[0.0; N]; N];
        let (info, y) = (self.info.as_mut_ptr().cast(), self.y.as_mut_ptr());
        // SAFETY: n and n n numbers, contiguous.
        done(unsafe { sys::ins_fusion_add(N as c_uint, info, y, x.as_ptr(), p.as_ptr().cast(), work.as_mut_ptr().cast()) })
    }

    /// The fused estimate and its covariance; refused if too little is known.
    pub fn solve(&self) -> Result<([Real; N], [[Real; N]; N]), Error> {
        let (mut x, mut p) = ([0.0; N], [[0.0; N]; N]);
        let info = self.info.as_ptr().cast();
        // SAFETY: n and n n numbers, contiguous.
        done(unsafe { sys::ins_fusion_solve(N as c_uint, info, self.y.as_ptr(), x.as_mut_ptr(), p.as_mut_ptr().cast()) })?;
        Ok((x, p))
    }
}

/// P / beta for a local filter, also Q / beta; beta in (0, 1\], their sum over the filters 1.
pub fn share<const N: usize>(p: &[[Real; N]; N], beta: Real) -> Result<[[Real; N]; N], Error> {
    let mut local = [[0.0; N]; N];
    // SAFETY: n n numbers each, contiguous.
    done(unsafe { sys::ins_fusion_share(N as c_uint, p.as_ptr().cast(), beta, local.as_mut_ptr().cast()) })?;
    Ok(local)
}

/// What positions come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Dead reckoning.
    Dr,
    /// GPS.
    Gps,
}

/// Limits of a good epoch, and `back`: good epochs in a row to go back to GPS, 3 against flicker.
pub type SwitchConfig = sys::ins_switch_config_t;

/// Starts in [`Mode::Dr`].
#[derive(Clone, Copy, Debug)]
pub struct Switch(sys::ins_switch_t);

impl Switch {
    /// `back` > 0, `hdop_max` > 0, `gate` >= 0.
    pub fn new(config: &SwitchConfig) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_switch_init(s, config) }).map(Self)
    }

    /// One GPS epoch; `nis` of its fix, or 0. To DR at the first bad epoch, to GPS after `back` good ones.
    pub fn epoch(&mut self, valid: bool, sats: u32, hdop: Real, nis: Real) -> Mode {
        // SAFETY: the state is initialised.
        let mode = unsafe { sys::ins_switch_epoch(&mut self.0, c_int::from(valid), sats as c_uint, hdop, nis) };
        if mode == sys::INS_SWITCH_GPS as c_int {
            Mode::Gps
        } else {
            Mode::Dr
        }
    }

    /// Whether the last epoch was good.
    pub fn good(&self) -> bool {
        self.0.good != 0
    }
}
