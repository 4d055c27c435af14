//! What a call of the core came to, and the shapes of its calls: a state made, an array filled.
//! SPDX-License-Identifier: MIT
use crate::{sys, Real};
use core::ffi::{c_int, CStr};
use core::fmt;

/// Refused; nothing has changed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Error {
    /// An argument is out of range or not a number.
    Range,
    /// Not in this state: a transfer is in progress, or too little has been seen.
    State,
    /// Declarations and compiled core are of different versions.
    Abi,
    /// A measurement's innovation is outside the gate.
    Gate,
    /// A slice has another length than the call reads or writes.
    Length,
}

/// Done; whether the formula had all the samples it reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// As documented.
    Full,
    /// With fewer previous samples than the formula wants: the first few after the start.
    StartUp,
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let status = match self {
            Error::Range => sys::INS_E_RANGE,
            Error::State => sys::INS_E_STATE,
            Error::Abi => sys::INS_E_ABI,
            Error::Gate => sys::INS_E_GATE,
            Error::Length => return f.write_str("a slice has another length than the call reads or writes"),
        };
        // SAFETY: a string of static storage for any argument.
        let text = unsafe { CStr::from_ptr(sys::ins_status_text(status)) };
        f.write_str(text.to_str().unwrap_or("unknown status"))
    }
}

impl core::error::Error for Error {}

pub(crate) fn order(status: c_int) -> Result<Order, Error> {
    match status {
        sys::INS_S_START => Ok(Order::StartUp),
        0.. => Ok(Order::Full),
        sys::INS_E_RANGE => Err(Error::Range),
        sys::INS_E_STATE => Err(Error::State),
        sys::INS_E_GATE => Err(Error::Gate),
        _ => Err(Error::Abi), // a code that the bindings do not know
    }
}

pub(crate) fn done(status: c_int) -> Result<(), Error> {
    order(status).map(|_| ())
}

pub(crate) fn same_length(got: usize, want: usize) -> Result<(), Error> {
    if got == want {
        Ok(())
    } else {
        Err(Error::Length)
    }
}

/// A state made by its init function.
pub(crate) fn init<T: Default>(call: impl FnOnce(&mut T) -> c_int) -> Result<T, Error> {
    let mut state = T::default();
    done(call(&mut state)).map(|_| state)
}

/// What a call that cannot fail wrote.
pub(crate) fn fill<const N: usize>(call: impl FnOnce(*mut Real)) -> [Real; N] {
    let mut out = [0.0; N];
    call(out.as_mut_ptr());
    out
}

/// What a call wrote, and its order.
pub(crate) fn step<const N: usize>(call: impl FnOnce(*mut Real) -> c_int) -> Result<([Real; N], Order), Error> {
    let mut out = [0.0; N];
    let order = order(call(out.as_mut_ptr()))?;
    Ok((out, order))
}

/// What a call wrote.
pub(crate) fn get<const N: usize>(call: impl FnOnce(*mut Real) -> c_int) -> Result<[Real; N], Error> {
    step(call).map(|(out, _)| out)
}
