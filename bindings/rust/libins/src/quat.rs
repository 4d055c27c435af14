//! Attitude quaternions `[w, x, y, z]`, Hamilton: product, rotation, Euler angles, direction cosines, rotation vector. Unit: rad.
//!
//! `q_nb` turns body vectors into navigation. Euler angles are roll, pitch, yaw of the ZYX sequence. Source: docs/conventions.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, fill, get};
use crate::{sys, Error, Mat3, Quat, Vec3};

/// p q.
pub fn mul(p: &Quat, q: &Quat) -> Quat {
    // SAFETY: 4 numbers each.
    fill(|out| unsafe { sys::ins_quat_mul(p.as_ptr(), q.as_ptr(), out) })
}

/// q*, the inverse rotation of a unit quaternion.
pub fn conj(q: &Quat) -> Quat {
    // SAFETY: 4 numbers each.
    fill(|out| unsafe { sys::ins_quat_conj(q.as_ptr(), out) })
}

/// q_nb v_b q_nb*.
pub fn rotate(q_nb: &Quat, v_b: &Vec3) -> Vec3 {
    // SAFETY: 4 and 3 numbers in, 3 out.
    fill(|out| unsafe { sys::ins_quat_rotate(q_nb.as_ptr(), v_b.as_ptr(), out) })
}

/// To norm 1, exactly; refused for NaN, infinity or a norm out of 1e-15 to 1e15.
pub fn normalise(q: &mut Quat) -> Result<(), Error> {
    // SAFETY: 4 numbers.
    done(unsafe { sys::ins_quat_normalise(q.as_mut_ptr()) })
}

/// First order, without root or division, for | |q|^2 - 1 | < 1e-3.
pub fn normalise_approx(q: &mut Quat) {
    // SAFETY: 4 numbers.
    unsafe { sys::ins_quat_normalise_approx(q.as_mut_ptr()) }
}

/// Quaternion of a rotation vector of up to 1000 rad.
pub fn from_rotvec(phi: &Vec3) -> Result<Quat, Error> {
    // SAFETY: 3 numbers in, 4 out.
    get(|out| unsafe { sys::ins_quat_from_rotvec(phi.as_ptr(), out) })
}

/// From roll, pitch, yaw.
pub fn from_euler(euler: &Vec3) -> Quat {
    // SAFETY: 3 numbers in, 4 out.
    fill(|out| unsafe { sys::ins_quat_from_euler(euler.as_ptr(), out) })
}

/// Roll, pitch, yaw; at a pole of pitch roll is 0.
pub fn to_euler(q_nb: &Quat) -> Vec3 {
    // SAFETY: 4 numbers in, 3 out.
    fill(|out| unsafe { sys::ins_quat_to_euler(q_nb.as_ptr(), out) })
}

/// Direction cosines C_nb, row-major.
pub fn to_dcm(q_nb: &Quat) -> Mat3 {
    // SAFETY: 4 numbers in, 9 out.
    fill(|out| unsafe { sys::ins_quat_to_dcm(q_nb.as_ptr(), out) })
}

/// From direction cosines; refused unless they are a rotation within 1e-3.
pub fn from_dcm(c_nb: &Mat3) -> Result<Quat, Error> {
    // SAFETY: 9 numbers in, 4 out.
    get(|out| unsafe { sys::ins_quat_from_dcm(c_nb.as_ptr(), out) })
}
