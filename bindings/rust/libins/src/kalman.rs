//! Kalman filter of N states in fixed memory: Joseph form (full P) and UD form (P = U D U'). Matrices are row-major.
//!
//! One scalar measurement at a time. An extended filter moves its own x: [`Kalman::predict_covariance`], then
//! [`Innovation::v`] = z - h(x) and the Jacobian's row as h. Source: Joseph 1968, Bierman 1977; docs/kalman.md.
//!
//! ```
//! use libins::kalman::{Innovation, Kalman, GATE_99};
//! # fn main() -> Result<(), libins::Error> {
//! let mut filter = Kalman::new([0.0, 0.0], [[100.0, 0.0], [0.0, 10.0]]); // place [m], speed [m/s]
//! filter.predict(&[[1.0, 0.1], [0.0, 1.0]], &[[0.0, 0.0], [0.0, 1e-4]]);
//! filter.update(&[1.0, 0.0], &Innovation { v: 3.0 - filter.x[0], r: 1.0, gate: GATE_99 })?;
//! assert!(filter.x[0] > 2.9 && filter.nis() < 1.0);
//! # Ok(())
//! # }
//! ```
//! SPDX-License-Identifier: MIT
use crate::status::done;
use crate::{sys, Error, Real};
use core::ffi::{c_int, c_uint};

/// Chi-squared, 1 degree of freedom, 99 %.
pub const GATE_99: Real = sys::INS_KALMAN_GATE_99;
/// Chi-squared, 2 degrees of freedom, 99 %.
pub const GATE2_99: Real = sys::INS_KALMAN_GATE2_99;
/// Chi-squared, 1 degree of freedom, 99.9 %.
pub const GATE_999: Real = sys::INS_KALMAN_GATE_999;

/// One scalar measurement as a filter sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Innovation {
    /// z - h(x)
    pub v: Real,
    /// Variance of the measurement noise, > 0.
    pub r: Real,
    /// Refused if v^2 / (h P h' + r) is above; 0: no gate.
    pub gate: Real,
}

impl Innovation {
    /// Runs an update, and keeps the nis that it left.
    pub(crate) fn put(&self, nis: &mut Real, update: impl FnOnce(*mut sys::ins_innovation_t) -> c_int) -> Result<(), Error> {
        let mut raw = sys::ins_innovation_t { v: self.v, r: self.r, gate: self.gate, nis: 0.0 };
        let status = update(&mut raw);
        *nis = raw.nis;
        done(status)
    }
}

/// Scratch of the Joseph functions, n n + n numbers; an update leaves its gain in the first n.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct JosephWork<const N: usize> {
    square: [[Real; N]; N],
    row: [Real; N],
}

/// Scratch of the UD functions, 2 n n + 4 n numbers.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
struct UdWork<const N: usize> {
    squares: [[[Real; N]; N]; 2],
    rows: [[Real; N]; 4],
}

fn pointer<T>(work: &mut T) -> *mut Real {
    (work as *mut T).cast()
}

/// Joseph form. The state is the caller's to read and to set.
#[derive(Clone, Copy, Debug)]
pub struct Kalman<const N: usize> {
    /// State.
    pub x: [Real; N],
    /// Its covariance, symmetric.
    pub p: [[Real; N]; N],
    work: JosephWork<N>,
    nis: Real,
}

impl<const N: usize> Kalman<N> {
    const SOME: () = assert!(N > 0, "a filter has a state");

    /// Start and its covariance.
    pub fn new(x: [Real; N], p: [[Real; N]; N]) -> Self {
        let () = Self::SOME;
        Self { x, p, work: JosephWork { square: [[0.0; N]; N], row: [0.0; N] }, nis: 0.0 }
    }

    /// x = Phi x and P = Phi P Phi' + Q.
    pub fn predict(&mut self, phi: &[[Real; N]; N], q: &[[Real; N]; N]) {
        let x = self.x.as_mut_ptr();
        self.raw_predict(x, phi, q);
    }

    /// P = Phi P Phi' + Q; the caller has moved x by its own model.
    pub fn predict_covariance(&mut self, phi: &[[Real; N]; N], q: &[[Real; N]; N]) {
        self.raw_predict(core::ptr::null_mut(), phi, q);
    }

    fn raw_predict(&mut self, x: *mut Real, phi: &[[Real; N]; N], q: &[[Real; N]; N]) {
        let p = self.p.as_mut_ptr().cast();
        // SAFETY: n n numbers each, contiguous; x null or n; the scratch is the documented size.
        unsafe { sys::ins_kalman_predict(N as c_uint, x, p, phi.as_ptr().cast(), q.as_ptr().cast(), pointer(&mut self.work)) }
    }

    /// One scalar measurement with the row `h` of H. [`Error::Gate`]: outside the gate, [`Kalman::nis`] says how far.
    pub fn update(&mut self, h: &[Real; N], z: &Innovation) -> Result<(), Error> {
        let (x, p, work) = (self.x.as_mut_ptr(), self.p.as_mut_ptr().cast(), pointer(&mut self.work));
        // SAFETY: n and n n numbers, contiguous; the scratch holds 2 n.
        z.put(&mut self.nis, |raw| unsafe { sys::ins_kalman_update(N as c_uint, x, p, h.as_ptr(), raw, work) })
    }

    /// Gain of the last update.
    pub fn gain(&self) -> &[Real; N] {
        &self.work.square[0]
    }

    /// v^2 / (h P h' + r) of the last update, also of a refused one.
    pub fn nis(&self) -> Real {
        self.nis
    }
}

/// UD form: twice the work, and stands a P0/R some 1e4 times larger in float. M is N (N + 1) / 2.
#[derive(Clone, Copy, Debug)]
pub struct Ud<const N: usize, const M: usize> {
    /// State.
    pub x: [Real; N],
    /// Factors packed by columns: U(i,j) at j (j+1)/2 + i, D(j) at j (j+1)/2 + j.
    pub ud: [Real; M],
    work: UdWork<N>,
    nis: Real,
}

impl<const N: usize, const M: usize> Ud<N, M> {
    const PACKED: () = assert!(N > 0 && M == N * (N + 1) / 2, "Ud<N, M>: M must be N (N + 1) / 2");

    /// Start and its covariance; refused if that is indefinite.
    pub fn new(x: [Real; N], p: &[[Real; N]; N]) -> Result<Self, Error> {
        Ok(Self { x, ud: Self::factor(p)?, work: UdWork { squares: [[[0.0; N]; N]; 2], rows: [[0.0; N]; 4] }, nis: 0.0 })
    }

    /// Factors of a symmetric, positive semidefinite matrix: of Q for [`Ud::predict`].
    pub fn factor(p: &[[Real; N]; N]) -> Result<[Real; M], Error> {
        let () = Self::PACKED;
        let mut ud = [0.0; M];
        let mut work = [[0.0; N]; N];
        // SAFETY: n n numbers in and of scratch, n (n + 1) / 2 out.
        done(unsafe { sys::ins_ud_factor(N as c_uint, p.as_ptr().cast(), ud.as_mut_ptr(), pointer(&mut work)) })?;
        Ok(ud)
    }

    /// P = U D U'.
    pub fn covariance(&self) -> [[Real; N]; N] {
        let mut p = [[0.0; N]; N];
        // SAFETY: n (n + 1) / 2 numbers in, n n out.
        unsafe { sys::ins_ud_covariance(N as c_uint, self.ud.as_ptr(), pointer(&mut p)) }
        p
    }

    /// x = Phi x and P = Phi P Phi' + Q, with [`Ud::factor`] of Q.
    pub fn predict(&mut self, phi: &[[Real; N]; N], q_ud: &[Real; M]) {
        let x = self.x.as_mut_ptr();
        self.raw_predict(x, phi, q_ud);
    }

    /// As [`Kalman::predict_covariance`].
    pub fn predict_covariance(&mut self, phi: &[[Real; N]; N], q_ud: &[Real; M]) {
        self.raw_predict(core::ptr::null_mut(), phi, q_ud);
    }

    fn raw_predict(&mut self, x: *mut Real, phi: &[[Real; N]; N], q_ud: &[Real; M]) {
        let (ud, work) = (self.ud.as_mut_ptr(), pointer(&mut self.work));
        // SAFETY: x null or n, n (n + 1) / 2, n n numbers; the scratch is the documented size.
        unsafe { sys::ins_ud_predict(N as c_uint, x, ud, phi.as_ptr().cast(), q_ud.as_ptr(), work) }
    }

    /// As [`Kalman::update`].
    pub fn update(&mut self, h: &[Real; N], z: &Innovation) -> Result<(), Error> {
        let (x, ud, work) = (self.x.as_mut_ptr(), self.ud.as_mut_ptr(), pointer(&mut self.work));
        // SAFETY: n and n (n + 1) / 2 numbers; the scratch holds 3 n.
        z.put(&mut self.nis, |raw| unsafe { sys::ins_ud_update(N as c_uint, x, ud, h.as_ptr(), raw, work) })
    }

    /// Gain of the last update.
    pub fn gain(&self) -> &[Real; N] {
        &self.work.squares[0][0]
    }

    /// As [`Kalman::nis`].
    pub fn nis(&self) -> Real {
        self.nis
    }
}
