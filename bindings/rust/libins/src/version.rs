//! Version of the compiled core, and the check that it is the one declared.
//! SPDX-License-Identifier: MIT
use crate::status::done;
use crate::{sys, Error, Real};
use core::ffi::c_long;

/// 10000 major + 100 minor + patch of the core that is linked.
pub fn version() -> i32 {
    // SAFETY: no memory is passed.
    unsafe { sys::ins_version() as i32 }
}

/// [`Error::Abi`] if the linked core is of another version or number type, as can be when a program links a core of its own.
pub fn check() -> Result<(), Error> {
    // SAFETY: no memory is passed.
    done(unsafe { sys::ins_abi_check(c_long::from(sys::INS_VERSION as i32), core::mem::size_of::<Real>() as u32) })
}
