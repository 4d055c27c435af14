//! First-order Gauss-Markov state in discrete time: x(k+1) = phi x(k) + w, var w = q. Source: the 2006 GIMU thesis, 2-27 to 2-29.
//! SPDX-License-Identifier: MIT
use crate::status::init;
use crate::{sys, Error, Real};

/// The thesis's gimballed gyro: standard deviation \[rad/s\] and time constant \[s\].
pub const GIMBAL: (Real, Real) = (sys::INS_MARKOV_GIMBAL_SIGMA, sys::INS_MARKOV_GIMBAL_TAU_S);
/// The thesis's strapdown gyro.
pub const STRAPDOWN: (Real, Real) = (sys::INS_MARKOV_STRAPDOWN_SIGMA, sys::INS_MARKOV_STRAPDOWN_TAU_S);

/// `phi`: transition over one step. `q`: variance that a step adds.
pub type Markov = sys::ins_markov_t;

/// For a step `dt` >= 0 \[s\], a time constant `tau` > 0 \[s\] and a standard deviation `sigma` >= 0.
pub fn markov(dt: Real, tau: Real, sigma: Real) -> Result<Markov, Error> {
    // SAFETY: the result is a valid place.
    init(|s| unsafe { sys::ins_markov_init(s, dt, tau, sigma) })
}
