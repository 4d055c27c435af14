//! Attitude of many trajectories at once, for Monte Carlo: structure of arrays, the bits of [`crate::attitude`]. Frame: b -> n.
//!
//! Number r of trajectory i stands at `r * n + i`. The form is Hist2Opt. docs/batch.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, order, same_length};
use crate::{sys, Error, Order, Real};

/// Numbers of state a trajectory takes.
pub const ROWS: usize = sys::INS_BATCH_ROWS as usize;

/// n trajectories over the caller's memory.
#[derive(Debug)]
pub struct Batch<'a> {
    raw: sys::ins_batch_t,
    state: &'a mut [Real],
}

impl<'a> Batch<'a> {
    /// `state`: [`ROWS`] n numbers of scratch. `q_nb`: 4 n, by rows.
    pub fn new(state: &'a mut [Real], q_nb: &[Real]) -> Result<Self, Error> {
        let n = q_nb.len() / 4;
        same_length(q_nb.len(), 4 * n)?;
        same_length(state.len(), ROWS * n)?;
        let mut raw = sys::ins_batch_t::default();
        // SAFETY: the lengths are those of n trajectories.
        done(unsafe { sys::ins_batch_init(&mut raw, n, state.as_mut_ptr(), q_nb.as_ptr()) })?;
        Ok(Self { raw, state })
    }

    /// One increment each, `dtheta_b`: 3 n numbers by rows \[rad\]. All are done or none.
    pub fn step(&mut self, dtheta_b: &[Real]) -> Result<Order, Error> {
        same_length(dtheta_b.len(), 3 * self.raw.n)?;
        // SAFETY: the lengths are those of n trajectories; a shared slice cannot be part of the state.
        order(unsafe { sys::ins_batch_step(&mut self.raw, self.state.as_mut_ptr(), dtheta_b.as_ptr()) })
    }

    /// The attitudes, 4 n numbers by rows.
    pub fn q_nb(&self) -> &[Real] {
        &self.state[..4 * self.raw.n]
    }
}
