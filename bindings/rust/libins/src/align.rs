//! Start attitude and start biases: means with their standard error, levelling, two-vector alignment. Frames: b -> n (NED).
//!
//! Source: Black 1964 (TRIAD), Welford 1962 (mean); docs/align.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, get, init};
use crate::{sys, Error, Quat, Real, Vec3};

/// Mean of three channels: a gyro's null in codes, a fractional number, or a specific force.
#[derive(Clone, Copy, Debug)]
pub struct Mean(sys::ins_mean_t);

impl Mean {
    /// `quantum`: step of a sample, 0 if it has none.
    pub fn new(quantum: Real) -> Result<Self, Error> {
        // SAFETY: the state is a valid place.
        init(|s| unsafe { sys::ins_mean_init(s, quantum) }).map(Self)
    }

    /// One sample.
    pub fn add(&mut self, sample: &Vec3) -> Result<(), Error> {
        // SAFETY: 3 numbers.
        done(unsafe { sys::ins_mean_add(&mut self.0, sample.as_ptr()) })
    }

    /// Mean and its standard error for independent samples; [`Error::State`] with fewer than 2.
    pub fn get(&self) -> Result<(Vec3, Vec3), Error> {
        let mut error = [0.0; 3];
        // SAFETY: 3 numbers each.
        let mean = get(|out| unsafe { sys::ins_mean_get(&self.0, out, error.as_mut_ptr()) })?;
        Ok((mean, error))
    }

    /// Samples so far.
    pub fn count(&self) -> u32 {
        self.0.count
    }
}

/// Roll and pitch from the mean specific force at rest, of any length > 0, and the heading of the nose from north to east \[rad\].
pub fn level(f_b: &Vec3, heading: Real) -> Result<Quat, Error> {
    // SAFETY: 3 numbers in, 4 out.
    get(|out| unsafe { sys::ins_align_level(f_b.as_ptr(), heading, out) })
}

/// Attitude from two directions known in both frames: the first is met exactly, the second gives the turn about it.
pub fn triad(first_b: &Vec3, second_b: &Vec3, first_n: &Vec3, second_n: &Vec3) -> Result<Quat, Error> {
    // SAFETY: 3 numbers each in, 4 out.
    get(|out| unsafe { sys::ins_align_triad(first_b.as_ptr(), second_b.as_ptr(), first_n.as_ptr(), second_n.as_ptr(), out) })
}
