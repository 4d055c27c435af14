// Made by bindings/rust/generate from libins/core/include/ins/ins.h: do not edit.

pub const INS_VECTORS: u32 = 1;
pub const INS_ACCELFIT_N: u32 = 8;
pub const INS_CONING_SAMPLES_MAX: u32 = 4;
pub const INS_BATCH_ROWS: u32 = 10;
pub const INS_DR_RATE: u32 = 1;
pub const INS_DR_DISTANCE: u32 = 2;
pub const INS_FITER_SAMPLES_MAX: u32 = 5;
pub const INS_FITER_DEGREE: u32 = 80;
pub const INS_SWITCH_BACK_PAPER: u32 = 1;
pub const INS_SWITCH_BACK_GOOD: u32 = 3;
pub const INS_GIMU_T1_LEN: u32 = 14;
pub const INS_GIMU_T2_LEN: u32 = 23;
pub const INS_GIMU_LOOK: u32 = 25;
pub const INS_GIMU_RATE_HZ: u32 = 6;
pub const INS_GPS_DR_HEADINGS: u32 = 8;
pub const INS_KF15_N: u32 = 15;
pub const INS_KF15_ROW: u32 = 16;
pub const INS_GPS_INS_PAST: u32 = 8;
pub const INS_KF15_SCALE_N: u32 = 6;
pub const INS_SIXACC_MAX: u32 = 12;
pub const INS_GYRO_FREE_N: u32 = 18;
pub const INS_HS_BLOCK_MAX: u32 = 32;
pub const INS_HS_REQUEST: u32 = 170;
pub const INS_HS_READY: u32 = 187;
pub const INS_HS_ACCEPT: u32 = 0;
pub const INS_HS_RESEND: u32 = 255;
pub const INS_LINK_REQUEST: u32 = 85;
pub const INS_LINK_READY: u32 = 68;
pub const INS_LINK_PROBE_EVERY: u32 = 16;
pub const INS_LINK_BLOCK_MAX: u32 = 15;
pub const INS_LINK_CRC_START: u32 = 65535;
pub const INS_NAV_BLOCK_LEN: u32 = 32;
pub const INS_NAV_BLOCK_VERSION: u32 = 1;
pub const INS_NAV_BLOCK_OLD: u32 = 255;
pub const INS_NMEA_BODY_MAX: u32 = 100;
pub const INS_ROTVEC_MAX: u32 = 1000;
pub const INS_RATES_ORDER_MAX: u32 = 5;
pub const INS_SELFTEST_ABI: u32 = 1;
pub const INS_SELFTEST_CONING: u32 = 2;
pub const INS_SELFTEST_STEP: u32 = 4;
pub const INS_SELFTEST_FITER: u32 = 8;
pub const INS_SELFTEST_RATES: u32 = 16;
pub const INS_SELFTEST_FIXED: u32 = 32;
pub const INS_TM_ORDER: u32 = 6;
pub const INS_VERSION_MAJOR: u32 = 0;
pub const INS_VERSION_MINOR: u32 = 1;
pub const INS_VERSION_PATCH: u32 = 0;
pub const INS_VERSION: u32 = 100;
#[doc = "One octet on a wire, 0..255, in whatever the machine's smallest integer is (16 bits on a C28x): mask on every store."]
pub type ins_octet_t = uint_least8_t;
#[doc = "0 = done; negative = refused and nothing changed; positive = done, with a remark."]
pub type ins_status_t = ::core::ffi::c_int;
pub const INS_OK: _bindgen_ty_1 = 0;
pub const INS_E_RANGE: _bindgen_ty_1 = -1;
pub const INS_E_STATE: _bindgen_ty_1 = -2;
pub const INS_E_ABI: _bindgen_ty_1 = -3;
pub const INS_E_GATE: _bindgen_ty_1 = -4;
pub const INS_S_START: _bindgen_ty_1 = 1;
pub const INS_STATUS_COUNT_: _bindgen_ty_1 = 6;
pub type _bindgen_ty_1 = ::core::ffi::c_int;
#[doc = "What the fixture does at the body's origin, all resolved in b. At rest f_b is +g along the upward vertical."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_accelfit_motion_t {
    #[doc = "specific force [m/s^2]"]
    pub f_b: [ins_real; 3usize],
    #[doc = "angular rate [rad/s]"]
    pub w_ib_b: [ins_real; 3usize],
    #[doc = "angular acceleration [rad/s^2]"]
    pub wd_ib_b: [ins_real; 3usize],
}
#[doc = "Owned by the caller."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_accelfit_t {
    #[doc = "nominal axis, and the two directions in which it may lean"]
    pub u0: [ins_real; 3usize],
    #[doc = "nominal axis, and the two directions in which it may lean"]
    pub e1: [ins_real; 3usize],
    #[doc = "nominal axis, and the two directions in which it may lean"]
    pub e2: [ins_real; 3usize],
    #[doc = "the present estimate"]
    pub p: [ins_real; 8usize],
    #[doc = "triangle of the rows of this pass"]
    pub R: [ins_real; 64usize],
    #[doc = "their right-hand side"]
    pub z: [ins_real; 8usize],
    #[doc = "sum of squared residuals about p of this pass"]
    pub residual2: ins_real,
    #[doc = "rows of this pass"]
    pub rows: u32,
}
impl Default for ins_accelfit_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "\\param[in] u0  [3] nominal axis, not zero. \\param[in] e1  [3] direction of m1. \\param[in] e2  [3] direction of m2."]
    #[doc = "\\param[in] p  [8] first guess; SF not zero. \\return INS_OK; INS_E_RANGE for a zero axis or SF, NaN or infinity."]
    pub fn ins_accelfit_init(
        self_: *mut ins_accelfit_t,
        u0: *const ins_real,
        e1: *const ins_real,
        e2: *const ins_real,
        p: *const ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "What the accelerometer of the present estimate reads, and the derivatives by p."]
    #[doc = "\\param[out] jacobian  [8], or a null pointer. \\return the reading."]
    pub fn ins_accelfit_predict(self_: *const ins_accelfit_t, motion: *const ins_accelfit_motion_t, jacobian: *mut ins_real) -> ins_real;
}
extern "C" {
    #[doc = "One measurement. \\return INS_OK; INS_E_RANGE for NaN or infinity, and then self is unchanged."]
    pub fn ins_accelfit_add(self_: *mut ins_accelfit_t, motion: *const ins_accelfit_motion_t, reading: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Ends a pass: moves p by the least-squares step and begins the next pass, without rows."]
    #[doc = "\\param[out] largest  largest component of the step, in its own unit."]
    #[doc = "\\return INS_OK; INS_E_STATE, and self unchanged, while the rows seen do not fix all eight parameters."]
    pub fn ins_accelfit_step(self_: *mut ins_accelfit_t, largest: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Standard deviations of p by the rows of this pass (before ins_accelfit_step)."]
    #[doc = "\\param[in] sigma  of one reading. \\param[out] deviation  [8]. \\return as ins_accelfit_step; INS_E_RANGE unless sigma >= 0."]
    pub fn ins_accelfit_deviation(self_: *const ins_accelfit_t, sigma: ins_real, deviation: *mut ins_real) -> ins_status_t;
}
#[doc = "Mean of three channels: a gyro's null in codes, or a specific force. A null is a fractional number: rounded to a code it is up to"]
#[doc = "half a code wrong, 6.3 deg/min with the 12-bit gyros of the thesis."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_mean_t {
    pub count: u32,
    #[doc = "step of a sample, 0 if it has none"]
    pub quantum: ins_real,
    pub mean: [ins_real; 3usize],
    #[doc = "sum of squared deviations"]
    pub m2: [ins_real; 3usize],
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE unless quantum >= 0."]
    pub fn ins_mean_init(self_: *mut ins_mean_t, quantum: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN or infinity, unchanged."]
    pub fn ins_mean_add(self_: *mut ins_mean_t, sample: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] mean  [3]. \\param[out] error  [3] its standard error, for samples that are independent. A channel with less noise than"]
    #[doc = "a third of its quantum hides its null between two codes: its error is then quantum / sqrt(12), however many samples there are."]
    #[doc = "\\return INS_OK; INS_E_STATE with fewer than 2 samples."]
    pub fn ins_mean_get(self_: *const ins_mean_t, mean: *mut ins_real, error: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Roll and pitch from the specific force at rest, and a heading given. With the nose straight up or down, roll is 0."]
    #[doc = "\\param[in] f_b  [3] mean specific force, any length > 0. \\param[in] heading  of the nose, from north to east [rad]."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, infinity, no length or |heading| > 2 pi, q_nb unchanged."]
    pub fn ins_align_level(f_b: *const ins_real, heading: ins_real, q_nb: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Attitude from two directions known in both frames: the first is met exactly, the second gives the turn about it."]
    #[doc = "At rest: -f_b with {0, 0, 1}, and Earth rate or magnetic field. Any lengths > 0."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, infinity, or if the two are within 1e-3 rad of a line in b or in n, q_nb unchanged."]
    pub fn ins_align_triad(
        first_b: *const ins_real,
        second_b: *const ins_real,
        first_n: *const ins_real,
        second_n: *const ins_real,
        q_nb: *mut ins_real,
    ) -> ins_status_t;
}
#[doc = "Phi = theta: no correction (block of 1, or no history)"]
pub const INS_CONING_ONE: _bindgen_ty_2 = 0;
#[doc = "1 increment before the interval"]
pub const INS_CONING_HIST1: _bindgen_ty_2 = 1;
pub const INS_CONING_HIST2_FIT: _bindgen_ty_2 = 2;
#[doc = "the default"]
pub const INS_CONING_HIST2_OPT: _bindgen_ty_2 = 3;
pub const INS_CONING_HIST3_FIT: _bindgen_ty_2 = 4;
pub const INS_CONING_HIST3_OPT: _bindgen_ty_2 = 5;
pub const INS_CONING_BLOCK2: _bindgen_ty_2 = 6;
#[doc = "33/80, 57/80: equation 5 of Zheng and Zhou (2010)"]
pub const INS_CONING_BLOCK3_FIT: _bindgen_ty_2 = 7;
pub const INS_CONING_BLOCK3_OPT: _bindgen_ty_2 = 8;
pub const INS_CONING_BLOCK4_FIT: _bindgen_ty_2 = 9;
pub const INS_CONING_BLOCK4_OPT: _bindgen_ty_2 = 10;
#[doc = "history of 2, least peak drift for vibration of up to 0.3 rad of phase an increment: 0.048 / T"]
pub const INS_CONING_HIST2_MU03: _bindgen_ty_2 = 11;
#[doc = "up to 0.6 rad"]
pub const INS_CONING_HIST2_MU06: _bindgen_ty_2 = 12;
#[doc = "up to 1 rad"]
pub const INS_CONING_HIST2_MU10: _bindgen_ty_2 = 13;
pub const INS_CONING_FORM_COUNT: _bindgen_ty_2 = 14;
#[doc = "Where FIT and OPT are the same there is one name. MU: coefficients shaped for a band of vibration frequencies."]
pub type _bindgen_ty_2 = ::core::ffi::c_uint;
extern "C" {
    #[doc = "Increments a form reads, 1 .. INS_CONING_SAMPLES_MAX; 0 if there is no such form."]
    pub fn ins_coning_samples(form: ::core::ffi::c_int) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "1 if the form spans all its increments, 0 if only the last (history forms)."]
    pub fn ins_coning_is_block(form: ::core::ffi::c_int) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "\\param[in] theta_b  [ins_coning_samples(form) * 3], oldest first. \\param[out] phi_b  [3] rotation vector of the interval."]
    #[doc = "\\return INS_OK; INS_E_RANGE if there is no such form. NaN in gives NaN out."]
    pub fn ins_coning_phi(form: ::core::ffi::c_int, theta_b: *const ins_real, phi_b: *mut ins_real) -> ins_status_t;
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_attitude_t {
    #[doc = "scalar first; v_n = q v_b q*"]
    pub q_nb: [ins_real; 4usize],
    #[doc = "previous increments, newest first [rad]"]
    pub prev: [[ins_real; 3usize]; 3usize],
    #[doc = "INS_CONING_ONE or one of INS_CONING_HIST*"]
    pub form: uint_least8_t,
    #[doc = "previous increments held"]
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE for a block form, NaN, or a quaternion whose norm is not within 1e-3 of 1 (it is normalised)."]
    pub fn ins_attitude_init(self_: *mut ins_attitude_t, form: ::core::ffi::c_int, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Add one increment, each component in [-0.5, 0.5] for the accuracy stated in docs/coning.md; larger is done exactly but slower."]
    #[doc = "\\return INS_OK; INS_S_START; INS_E_RANGE for NaN or |component| > pi, and then self is unchanged."]
    pub fn ins_attitude_step(self_: *mut ins_attitude_t, dtheta_b: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Turn of the navigation frame over the same time: q_nb := q(-dzeta) q_nb. Optional, once an increment or less often."]
    #[doc = "\\param[in] dzeta_n  [3] integral of w_in_n: Earth rate w_ie (cos L, 0, -sin L) in NED, without which level and heading drift by up to"]
    #[doc = "15 deg/h, plus transport rate (v_E / (N + h), -v_N / (M + h), -v_E tan L / (N + h)) [rad]."]
    #[doc = "\\return INS_OK; INS_E_RANGE as ins_quat_from_rotvec, and then self is unchanged."]
    pub fn ins_attitude_turn_frame(self_: *mut ins_attitude_t, dzeta_n: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Add one rotation that spans a gap; the history restarts."]
    pub fn ins_attitude_jump(self_: *mut ins_attitude_t, phi_b: *const ins_real) -> ins_status_t;
}
#[doc = "Start with ins_batch_init(). Members are private. The state stays with the caller."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_batch_t {
    pub n: usize,
    #[doc = "previous increments held"]
    pub count: uint_least8_t,
    #[doc = "bit k: a component above 0.25 rad k + 1 steps ago"]
    pub large: uint_least8_t,
    #[doc = "first row of the newest increment, 4 or 7"]
    pub newest: uint_least8_t,
}
extern "C" {
    #[doc = "\\param[in] q_nb  [4 * n] by rows, scalar first. \\param[out] state  [INS_BATCH_ROWS * n]"]
    #[doc = "\\return INS_OK; INS_E_RANGE for n = 0, NaN, or a norm not within 1e-3 of 1 (they are normalised), and then nothing has changed."]
    pub fn ins_batch_init(self_: *mut ins_batch_t, n: usize, state: *mut ins_real, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] dtheta_b  [3 * n] by rows [rad]; not part of state."]
    #[doc = "\\return INS_OK; INS_S_START; INS_E_RANGE if any is NaN or any |component| > pi, and then nothing has changed."]
    pub fn ins_batch_step(self_: *mut ins_batch_t, state: *mut ins_real, dtheta_b: *const ins_real) -> ins_status_t;
}
#[doc = "One scalar measurement as the filter sees it."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_innovation_t {
    #[doc = "z - h(x)"]
    pub v: ins_real,
    #[doc = "variance of the measurement noise, > 0"]
    pub r: ins_real,
    #[doc = "refused if v^2 / (h P h' + r) is above; 0: no gate"]
    pub gate: ins_real,
    #[doc = "out: v^2 / (h P h' + r), set also when refused by the gate"]
    pub nis: ins_real,
}
extern "C" {
    #[doc = "x = Phi x and P = Phi P Phi' + Q."]
    #[doc = "\\param[in,out] x  [n], or 0: the caller has moved it by its own model. \\param[in,out] P  [n n] symmetric."]
    #[doc = "\\param[in] Phi  [n n]. \\param[in] Q  [n n]. \\param work  [INS_KALMAN_WORK(n)]."]
    pub fn ins_kalman_predict(
        n: ::core::ffi::c_uint,
        x: *mut ins_real,
        P: *mut ins_real,
        Phi: *const ins_real,
        Q: *const ins_real,
        work: *mut ins_real,
    );
}
extern "C" {
    #[doc = "x = x + K v and P = (I - K h) P (I - K h)' + K r K'."]
    #[doc = "\\param[in] h  [n] row of H. \\param[out] work  [2 n]; the gain K is left in work[0..n-1]."]
    #[doc = "\\return INS_OK; INS_E_GATE: outside the gate, z->nis says how far; INS_E_RANGE: v or h P h' is not a number, or r is not"]
    #[doc = "positive. Refused means that x and P are unchanged."]
    pub fn ins_kalman_update(
        n: ::core::ffi::c_uint,
        x: *mut ins_real,
        P: *mut ins_real,
        h: *const ins_real,
        z: *mut ins_innovation_t,
        work: *mut ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "P = U D U'. \\param[in] P  [n n] symmetric, positive semidefinite. \\param[out] UD  [INS_UD_SIZE(n)]. \\param work  [n n]."]
    #[doc = "\\return INS_OK; INS_E_RANGE: P is indefinite (beyond the rounding of its diagonal) or not a number; UD is then unchanged."]
    pub fn ins_ud_factor(n: ::core::ffi::c_uint, P: *const ins_real, UD: *mut ins_real, work: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "P = U D U', from the factors."]
    pub fn ins_ud_covariance(n: ::core::ffi::c_uint, UD: *const ins_real, P: *mut ins_real);
}
extern "C" {
    #[doc = "x = Phi x and U D U' = Phi U D U' Phi' + Q by modified weighted Gram-Schmidt (Thornton)."]
    #[doc = "\\param[in,out] x  [n] or 0. \\param[in] Q_ud  [INS_UD_SIZE(n)] ins_ud_factor() of Q. \\param work  [INS_UD_WORK(n)]."]
    pub fn ins_ud_predict(
        n: ::core::ffi::c_uint,
        x: *mut ins_real,
        UD: *mut ins_real,
        Phi: *const ins_real,
        Q_ud: *const ins_real,
        work: *mut ins_real,
    );
}
extern "C" {
    #[doc = "As ins_kalman_update(), on the factors (Bierman). \\param[out] work  [3 n]; the gain K is left in work[0..n-1]."]
    pub fn ins_ud_update(
        n: ::core::ffi::c_uint,
        x: *mut ins_real,
        UD: *mut ins_real,
        h: *const ins_real,
        z: *mut ins_innovation_t,
        work: *mut ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "One step along a circular arc. \\param[in,out] pose  [3] east, north, heading. \\param[in] distance  along the arc [m]."]
    #[doc = "\\param[in] turn  change of heading [rad]. \\return INS_E_RANGE, pose unchanged: not a number, or an angle beyond +-1000 rad."]
    pub fn ins_dead_reckoning_step(pose: *mut ins_real, distance: ins_real, turn: ins_real) -> ins_status_t;
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_dr_ekf_config_t {
    #[doc = "[s]"]
    pub dt: ins_real,
    #[doc = "correlation time of the acceleration, east and north [s]"]
    pub tau: [ins_real; 2usize],
    #[doc = "its standard deviation [m/s^2]"]
    pub sigma: [ins_real; 2usize],
    #[doc = "variance of the yaw rate [(rad/s)^2]"]
    pub r_rate: ins_real,
    #[doc = "variance of the distance in dt [m^2]"]
    pub r_distance: ins_real,
    #[doc = "predicted speed below which the yaw rate is not used [m/s]: 0.5 is good"]
    pub v_min: ins_real,
    #[doc = "predicted speed below which nothing is used [m/s]: 1e-3 is good"]
    pub v_zero: ins_real,
    #[doc = "of each innovation, as ins_innovation_t; 0: none"]
    pub gate: ins_real,
}
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_dr_ekf_t {
    pub cfg: ins_dr_ekf_config_t,
    #[doc = "east, north, their velocities, their accelerations"]
    pub x: [ins_real; 6usize],
    pub P: [ins_real; 36usize],
    pub Phi: [ins_real; 36usize],
    pub Q: [ins_real; 36usize],
    #[doc = "what the last step used: INS_DR_RATE, INS_DR_DISTANCE"]
    pub used: ::core::ffi::c_uint,
    #[doc = "of yaw rate and distance in the last step; 0 if it was not looked at"]
    pub nis: [ins_real; 2usize],
    #[doc = "measurements refused by the gate"]
    pub gated: uint_least32_t,
}
impl Default for ins_dr_ekf_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "\\param[in] x  [6] start. \\param[in] var  [6] its variances."]
    #[doc = "\\return INS_E_RANGE: dt, tau, r or v_zero is not positive, or sigma, var, gate or v_min - v_zero is negative, or one is not a"]
    #[doc = "number."]
    pub fn ins_dr_ekf_init(
        self_: *mut ins_dr_ekf_t,
        cfg: *const ins_dr_ekf_config_t,
        x: *const ins_real,
        var: *const ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "Predict by dt, then update with what may be used; both Jacobians are taken at the prediction."]
    #[doc = "\\return INS_OK; INS_E_GATE: one or both were refused by the gate (`used` says what was not); INS_E_RANGE: not a number, x and P"]
    #[doc = "unchanged."]
    pub fn ins_dr_ekf_step(self_: *mut ins_dr_ekf_t, yaw_rate: ins_real, distance: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] radii  [2] of the meridian and of the prime vertical [m]."]
    pub fn ins_earth_radii(sin_lat: ins_real, radii: *mut ins_real);
}
extern "C" {
    #[doc = "Normal gravity, positive down, centrifugal acceleration included [m/s^2]."]
    pub fn ins_earth_gravity(sin_lat: ins_real, height: ins_real) -> ins_real;
}
extern "C" {
    #[doc = "\\param[out] w_ie_n  [3] Earth against inertial space [rad/s]."]
    pub fn ins_earth_rate(sin_lat: ins_real, cos_lat: ins_real, w_ie_n: *mut ins_real);
}
extern "C" {
    #[doc = "\\param[in] cos_lat  not 0. \\param[out] w_en_n  [3] navigation frame against Earth [rad/s]."]
    pub fn ins_earth_transport_rate(sin_lat: ins_real, cos_lat: ins_real, height: ins_real, v_n: *const ins_real, w_en_n: *mut ins_real);
}
pub const INS_FITER_HIST0: _bindgen_ty_3 = 0;
pub const INS_FITER_HIST1: _bindgen_ty_3 = 1;
#[doc = "the last increment and 2 before it"]
pub const INS_FITER_HIST2: _bindgen_ty_3 = 2;
#[doc = "the default for slow sampling"]
pub const INS_FITER_HIST3: _bindgen_ty_3 = 3;
pub const INS_FITER_HIST4: _bindgen_ty_3 = 4;
#[doc = "the last 2 samples of the rate"]
pub const INS_FITER_RATE2: _bindgen_ty_3 = 5;
pub const INS_FITER_RATE3: _bindgen_ty_3 = 6;
pub const INS_FITER_RATE4: _bindgen_ty_3 = 7;
pub const INS_FITER_RATE5: _bindgen_ty_3 = 8;
#[doc = "3 increments, solved for all of them (ins_fiter_turn only)"]
pub const INS_FITER_BLOCK3: _bindgen_ty_3 = 9;
pub const INS_FITER_FORM_COUNT: _bindgen_ty_3 = 10;
#[doc = "What the polynomial goes through, and the interval it is solved for."]
pub type _bindgen_ty_3 = ::core::ffi::c_uint;
#[doc = "Start with ins_fiter_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_fiter_t {
    #[doc = "scalar first; v_n = q v_b q*"]
    pub q_nb: [ins_real; 4usize],
    #[doc = "previous increments, or rates times T, newest first [rad]"]
    pub prev: [[ins_real; 3usize]; 4usize],
    #[doc = "sample to angle: 1, or T for rates"]
    pub scale: ins_real,
    pub form: uint_least8_t,
    #[doc = "previous samples held"]
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "Samples a form reads, 1 .. INS_FITER_SAMPLES_MAX; 0 if there is no such form."]
    pub fn ins_fiter_samples(form: ::core::ffi::c_int) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "\\param[in] theta_b  [ins_fiter_samples(form) * 3] increments, or rates times T, oldest first [rad]; |component| <= pi."]
    #[doc = "\\param[out] dq  [4] rotation over the form's interval."]
    #[doc = "\\return INS_OK; INS_E_RANGE if there is no such form, for NaN, or if the series does not end within INS_FITER_DEGREE (increments of"]
    #[doc = "up to 0.5 rad always do, of a block up to 0.05), dq unchanged."]
    pub fn ins_fiter_turn(form: ::core::ffi::c_int, theta_b: *const ins_real, dq: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] period_s  T > 0 of a RATE form [s]; not read for increments."]
    #[doc = "\\return INS_OK; INS_E_RANGE for BLOCK3, NaN, or a quaternion whose norm is not within 1e-3 of 1 (it is normalised)."]
    pub fn ins_fiter_init(self_: *mut ins_fiter_t, form: ::core::ffi::c_int, period_s: ins_real, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Next increment [rad], or next sample of the rate [rad/s], the first one of which belongs to the start attitude and turns nothing."]
    #[doc = "\\return INS_OK; INS_S_START with fewer samples than the form reads; INS_E_RANGE as ins_fiter_turn, and then self is unchanged."]
    pub fn ins_fiter_step(self_: *mut ins_fiter_t, sample_b: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] info  [n n] and y [n]: nothing known."]
    pub fn ins_fusion_clear(n: ::core::ffi::c_uint, info: *mut ins_real, y: *mut ins_real);
}
extern "C" {
    #[doc = "\\param[in] x  [n], P [n n] an estimate and its covariance. \\param work  [n n]."]
    #[doc = "\\return INS_E_RANGE, and info and y unchanged: P is not positive definite."]
    pub fn ins_fusion_add(
        n: ::core::ffi::c_uint,
        info: *mut ins_real,
        y: *mut ins_real,
        x: *const ins_real,
        P: *const ins_real,
        work: *mut ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] x  [n], P [n n] the fused estimate; P is undefined when refused. \\return INS_E_RANGE: too little is known."]
    pub fn ins_fusion_solve(
        n: ::core::ffi::c_uint,
        info: *const ins_real,
        y: *const ins_real,
        x: *mut ins_real,
        P: *mut ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "P_local = P/beta (also for Q). \\param[in] beta  (0, 1]. \\return INS_E_RANGE: beta is not in there."]
    pub fn ins_fusion_share(n: ::core::ffi::c_uint, P: *const ins_real, beta: ins_real, P_local: *mut ins_real) -> ins_status_t;
}
pub const INS_SWITCH_DR: _bindgen_ty_4 = 0;
pub const INS_SWITCH_GPS: _bindgen_ty_4 = 1;
pub type _bindgen_ty_4 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_switch_config_t {
    #[doc = "4 is good"]
    pub hdop_max: ins_real,
    #[doc = "of the fix's nis, 2 degrees of freedom: INS_KALMAN_GATE2_99; 0: not looked at"]
    pub gate: ins_real,
    #[doc = "fewest satellites: 4"]
    pub sats: uint_least8_t,
    #[doc = "good epochs in a row to go from DR to GPS: INS_SWITCH_BACK_GOOD"]
    pub back: uint_least8_t,
}
#[doc = "Owned by the caller; readable. Starts in DR."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_switch_t {
    pub cfg: ins_switch_config_t,
    #[doc = "INS_SWITCH_DR or INS_SWITCH_GPS"]
    pub mode: uint_least8_t,
    #[doc = "the last epoch was good"]
    pub good: uint_least8_t,
    #[doc = "good epochs in a row, up to back"]
    pub run: uint_least8_t,
}
extern "C" {
    #[doc = "\\return INS_E_RANGE: back is 0, hdop_max is not positive, or gate is negative."]
    pub fn ins_switch_init(self_: *mut ins_switch_t, cfg: *const ins_switch_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "One GPS epoch. \\param[in] nis  of its fix, or 0 if there is none. A NaN in hdop or nis makes the epoch bad."]
    #[doc = "\\return the mode: to DR at the first bad epoch, to GPS after `back` good ones."]
    pub fn ins_switch_epoch(
        self_: *mut ins_switch_t,
        valid: ::core::ffi::c_int,
        sats: ::core::ffi::c_uint,
        hdop: ins_real,
        nis: ins_real,
    ) -> ::core::ffi::c_int;
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_ellipsoid_t {
    #[doc = "semi-major axis [m]"]
    pub a: ins_real,
    #[doc = "flattening"]
    pub f: ins_real,
    #[doc = "first eccentricity squared, f (2 - f)"]
    pub e2: ins_real,
}
extern "C" {
    pub static ins_wgs84: ins_ellipsoid_t;
}
extern "C" {
    #[doc = "of TWD97"]
    pub static ins_grs80: ins_ellipsoid_t;
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, infinity, |latitude| > pi/2, |longitude| > 2 pi."]
    pub fn ins_geodesy_to_ecef(ellipsoid: *const ins_ellipsoid_t, llh: *const ins_real, xyz_e: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Longitude in [-pi, pi]; on the axis it is 0. Two iterations: 1e-8 m up to 2e7 m of height."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, infinity, or a point nearer to the centre than INS_GEODESY_RADIUS_MIN."]
    pub fn ins_geodesy_from_ecef(ellipsoid: *const ins_ellipsoid_t, xyz_e: *const ins_real, llh: *mut ins_real) -> ins_status_t;
}
#[doc = "A tangent frame fixed to the Earth. Owned by the caller."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_local_t {
    #[doc = "[m]"]
    pub origin_e: [ins_real; 3usize],
    #[doc = "rows: north, east, down in e"]
    pub C_ne: [ins_real; 9usize],
}
extern "C" {
    #[doc = "\\param[in] llh  [3] of the origin. \\return as ins_geodesy_to_ecef."]
    pub fn ins_local_init(self_: *mut ins_local_t, ellipsoid: *const ins_ellipsoid_t, llh: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] ned  [3] from the origin [m]; may be xyz_e."]
    pub fn ins_local_from_ecef(self_: *const ins_local_t, xyz_e: *const ins_real, ned: *mut ins_real);
}
extern "C" {
    #[doc = "\\param[out] xyz_e  [3] [m]; may be ned."]
    pub fn ins_local_to_ecef(self_: *const ins_local_t, ned: *const ins_real, xyz_e: *mut ins_real);
}
extern "C" {
    #[doc = "NED to ENU, and ENU to NED: it is its own inverse. \\param[out] out  [3]; may be in."]
    pub fn ins_local_swap(in_: *const ins_real, out: *mut ins_real);
}
pub const INS_GIMU_NOTHING: _bindgen_ty_5 = 0;
pub const INS_GIMU_T1: _bindgen_ty_5 = 1;
pub const INS_GIMU_T2: _bindgen_ty_5 = 2;
#[doc = "What an octet led to."]
pub type _bindgen_ty_5 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gimu_packet_t {
    #[doc = "P, Q, R, AX, AY, AZ [LSB]"]
    pub raw: [u16; 6usize],
    #[doc = "as sent (type 2)"]
    pub coordinate: [u32; 2usize],
    #[doc = "[1e-7 deg] (type 2 with has_position)"]
    pub lat_e7: i32,
    pub lon_e7: i32,
    #[doc = "(type 2)"]
    pub sats: uint_least8_t,
    #[doc = "0 for type 1, and where both coordinates are above 90 degrees"]
    pub has_position: uint_least8_t,
}
#[doc = "Owned by the caller. Members are private, packet and the counters readable."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gimu_t {
    pub check_12_bits: uint_least8_t,
    #[doc = "octets waiting"]
    pub count: uint_least8_t,
    pub wait: [ins_octet_t; 25usize],
    #[doc = "the last one given out"]
    pub packet: ins_gimu_packet_t,
    #[doc = "packets of each type"]
    pub t1: u32,
    pub t2: u32,
    #[doc = "octets that belong to no packet"]
    pub skipped: u32,
}
extern "C" {
    #[doc = "\\param[in] check_12_bits  1: a sample above FFF is no sample. 0: it is; the thesis's figure 4.4 has such."]
    pub fn ins_gimu_init(self_: *mut ins_gimu_t, check_12_bits: ::core::ffi::c_int);
}
extern "C" {
    #[doc = "An octet came. At most one packet. \\return INS_GIMU_T1 or T2: it is in self->packet."]
    pub fn ins_gimu_rx(self_: *mut ins_gimu_t, octet: ins_octet_t) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "Nothing follows for now: judge what waits without the next header. Fewer than 14 octets go on waiting."]
    pub fn ins_gimu_flush(self_: *mut ins_gimu_t) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "A coordinate in 1e-7 degree, rounded. \\param[in] coordinate  as sent, plausible."]
    pub fn ins_gimu_e7(coordinate: u32) -> i32;
}
#[doc = "Scale of the sensors. A fractional null matters: half a unit is 6.3 degrees a minute."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gimu_scale_t {
    #[doc = "reading at rest [LSB], e.g. a mean of 60 samples or more"]
    pub null: [ins_real; 6usize],
    #[doc = "[rad/s per LSB]"]
    pub rate: [ins_real; 3usize],
    #[doc = "[m/s^2 per LSB]"]
    pub acceleration: ins_real,
}
extern "C" {
    #[doc = "The thesis's K for the gyros, the data sheet's for the accelerometers, nulls at 2047."]
    pub fn ins_gimu_scale_thesis(self_: *mut ins_gimu_scale_t);
}
extern "C" {
    #[doc = "Data-sheet values, nulls at 2047."]
    pub fn ins_gimu_scale_nominal(self_: *mut ins_gimu_scale_t);
}
extern "C" {
    #[doc = "Angle and velocity increments of one packet. \\param[in] raw  [6]. \\param[in] dt  [s], 1/6 for a GIMU."]
    #[doc = "\\param[out] dtheta_b  [3] rad. \\param[out] dv_b  [3] m/s."]
    pub fn ins_gimu_increments(self_: *const ins_gimu_scale_t, raw: *const u16, dt: ins_real, dtheta_b: *mut ins_real, dv_b: *mut ins_real);
}
#[doc = "What an IMU gives for one interval, each integrated in the moving body frame."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_increment_t {
    #[doc = "of the angular rate w_ib_b [rad]"]
    pub theta_b: [ins_real; 3usize],
    #[doc = "of the specific force f_b [m/s]"]
    pub v_b: [ins_real; 3usize],
}
#[doc = "Owned by the caller. Start with ins_sculling_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_sculling_t {
    #[doc = "attitude at the end of the last interval"]
    pub q_nb: [ins_real; 4usize],
    #[doc = "previous increments, newest first"]
    pub prev: [ins_increment_t; 3usize],
    #[doc = "as in ins_attitude_t"]
    pub form: uint_least8_t,
    #[doc = "previous increments held"]
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "\\return as ins_attitude_init."]
    pub fn ins_sculling_init(self_: *mut ins_sculling_t, form: ::core::ffi::c_int, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Next interval: attitude and velocity increment. Angles as in ins_attitude_step."]
    #[doc = "\\param[out] dv_b  [3] specific force integrated in b as it stood at the start of the interval [m/s]; not in the increment."]
    #[doc = "\\return INS_OK; INS_S_START; INS_E_RANGE for NaN, infinity or |component of theta_b| > pi; nothing is changed then."]
    pub fn ins_sculling_step(self_: *mut ins_sculling_t, increment: *const ins_increment_t, dv_b: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "The correction alone, for any form: as ins_coning_phi. \\param[in] increments  [ins_coning_samples(form)], oldest first."]
    #[doc = "\\return INS_OK; INS_E_RANGE if there is no such form. NaN in gives NaN out."]
    pub fn ins_sculling_dv(form: ::core::ffi::c_int, increments: *const ins_increment_t, dv_b: *mut ins_real) -> ins_status_t;
}
#[doc = "Latitude, longitude [rad] and height above WGS-84 [m]: the sum of both."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_position_t {
    pub anchor: [ins_real; 3usize],
    pub offset: [ins_real; 3usize],
}
#[doc = "Owned by the caller. Start with ins_strapdown_init(); read sculling.q_nb, v_n and position."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_strapdown_t {
    #[doc = "its q_nb is the attitude"]
    pub sculling: ins_sculling_t,
    #[doc = "velocity over ground [m/s]"]
    pub v_n: [ins_real; 3usize],
    pub position: ins_position_t,
    #[doc = "of the anchor"]
    pub sin_lat: ins_real,
    #[doc = "of the anchor"]
    pub cos_lat: ins_real,
    #[doc = "[s]"]
    pub half_period: ins_real,
    #[doc = "half of the last step's change of velocity [m/s]"]
    pub half_dv: [ins_real; 3usize],
    #[doc = "and of latitude [rad]"]
    pub half_dlat: ins_real,
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE for what ins_attitude_init refuses, NaN, a period not in (0, INS_STRAPDOWN_PERIOD_MAX], a speed above INS_STRAPDOWN_SPEED_MAX, |height| > 1e6 m,"]
    #[doc = "        |longitude| > 2 pi, an offset of more than 1e-3 rad, or a latitude too near to a pole."]
    pub fn ins_strapdown_init(
        self_: *mut ins_strapdown_t,
        form: ::core::ffi::c_int,
        period_s: ins_real,
        q_nb: *const ins_real,
        v_n: *const ins_real,
        position: *const ins_position_t,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "\\return INS_OK; INS_S_START; INS_E_RANGE as ins_sculling_step, or if the step would lead too near to a pole; nothing is changed"]
    #[doc = "        then."]
    pub fn ins_strapdown_step(self_: *mut ins_strapdown_t, increment: *const ins_increment_t) -> ins_status_t;
}
extern "C" {
    #[doc = "Another point of the body: an antenna, a wheel."]
    #[doc = "\\param[in] l_b  [3] from the IMU to the point [m]. \\param[in] w_ib_b  [3] angular rate now, e.g. increment / period [rad/s]."]
    #[doc = "\\param[out] v_n  [3] its velocity over ground [m/s]. \\param[out] position  of the point."]
    pub fn ins_strapdown_point(
        self_: *const ins_strapdown_t,
        l_b: *const ins_real,
        w_ib_b: *const ins_real,
        v_n: *mut ins_real,
        position: *mut ins_position_t,
    );
}
extern "C" {
    #[doc = "From a to b along the meridian and the parallel through a, and down [m]. Offsets and anchors are subtracted one from the other"]
    #[doc = "first, so nothing is lost in float."]
    pub fn ins_position_difference(a: *const ins_position_t, b: *const ins_position_t, ned: *mut ins_real);
}
#[doc = "What a receiver says of its antenna. A standard deviation of 0: this figure is not known, and not used."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gnss_fix_t {
    #[doc = "of which it is, in the time base of the IMU"]
    pub t_ns: i64,
    pub position: ins_position_t,
    #[doc = "over ground [m/s]"]
    pub v_n: [ins_real; 3usize],
    #[doc = "north, east, down [m]"]
    pub sigma_p: [ins_real; 3usize],
    #[doc = "[m/s]"]
    pub sigma_v: [ins_real; 3usize],
}
extern "C" {
    #[doc = "t_ns plus the multiple of period_ns that brings it nearest to near_ns. \\param[in] period_ns  > 0."]
    pub fn ins_gnss_time_near(t_ns: i64, period_ns: i64, near_ns: i64) -> i64;
}
extern "C" {
    #[doc = "Position from integers as receivers send them, exact to 1e-9 deg in float too: the anchor is a coarse part, the offset the rest."]
    #[doc = "\\param[in] lat_e7  latitude [1e-7 deg]. \\param[in] lon_e7  longitude. \\param[in] height_mm  above the ellipsoid."]
    pub fn ins_gnss_position(lat_e7: i32, lon_e7: i32, height_mm: i32, position: *mut ins_position_t);
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_axis_config_t {
    #[doc = "epoch [s]"]
    pub dt: ins_real,
    #[doc = "[s]"]
    pub tau_acceleration: ins_real,
    #[doc = "[s]"]
    pub tau_fix: ins_real,
    #[doc = "[m/s^2]"]
    pub sigma_acceleration: ins_real,
    #[doc = "[m]"]
    pub sigma_fix: ins_real,
    #[doc = "variance of the white part of a fix [m^2]"]
    pub r: ins_real,
    #[doc = "of the innovation, as ins_innovation_t; 0: none"]
    pub gate: ins_real,
    #[doc = "[m/s^2]; 0: plain Singer model"]
    pub acceleration_max: ins_real,
}
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_axis_t {
    pub cfg: ins_gps_axis_config_t,
    #[doc = "position, velocity, acceleration, fix error"]
    pub x: [ins_real; 4usize],
    pub P: [ins_real; 16usize],
    pub Phi: [ins_real; 16usize],
    #[doc = "the motion's part for an acceleration of variance 1 (m/s^2)^2"]
    pub Q: [ins_real; 16usize],
    #[doc = "input of the mean acceleration"]
    pub u: [ins_real; 3usize],
    #[doc = "gain of the last update"]
    pub K: [ins_real; 4usize],
}
extern "C" {
    #[doc = "x = 0; set it if it is known. \\param[in] var  [4] variances of x."]
    #[doc = "\\return INS_E_RANGE: a time or r is not positive, a deviation is negative, or the two time constants are too close."]
    pub fn ins_gps_axis_init(self_: *mut ins_gps_axis_t, cfg: *const ins_gps_axis_config_t, var: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "One epoch on without a fix."]
    pub fn ins_gps_axis_predict(self_: *mut ins_gps_axis_t);
}
extern "C" {
    #[doc = "One epoch on, then the fix z [m]. \\param[out] nis  as ins_innovation_t, or 0. \\return as ins_kalman_update(); when it refuses the"]
    #[doc = "epoch is predicted all the same."]
    pub fn ins_gps_axis_step(self_: *mut ins_gps_axis_t, z: ins_real, nis: *mut ins_real) -> ins_status_t;
}
pub const INS_UNICYCLE_EAST: _bindgen_ty_6 = 0;
pub const INS_UNICYCLE_NORTH: _bindgen_ty_6 = 1;
pub const INS_UNICYCLE_HEADING: _bindgen_ty_6 = 2;
pub const INS_UNICYCLE_SPEED: _bindgen_ty_6 = 3;
pub const INS_UNICYCLE_BIAS: _bindgen_ty_6 = 4;
pub const INS_UNICYCLE_SCALE: _bindgen_ty_6 = 5;
pub type _bindgen_ty_6 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_unicycle_config_t {
    #[doc = "growth of the speed's variance [(m/s)^2/s]"]
    pub q_speed: ins_real,
    #[doc = "of the gyro bias's [(rad/s)^2/s]"]
    pub q_bias: ins_real,
    #[doc = "of the odometer scale's [1/s]"]
    pub q_scale: ins_real,
    #[doc = "variance of a yaw-rate sample [(rad/s)^2]"]
    pub r_rate: ins_real,
    #[doc = "variance of a distance [m^2]"]
    pub r_distance: ins_real,
    #[doc = "of the odometer's innovation, 1 degree of freedom; 0: none"]
    pub gate: ins_real,
    #[doc = "of a fix, 2 degrees of freedom: INS_KALMAN_GATE2_99 is good; 0: none"]
    pub gate_gps: ins_real,
}
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_unicycle_t {
    pub cfg: ins_unicycle_config_t,
    pub x: [ins_real; 6usize],
    pub P: [ins_real; 36usize],
}
impl Default for ins_unicycle_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "\\param[in] x  [6] start; the heading is wrapped. \\param[in] var  [6] its variances."]
    #[doc = "\\return INS_E_RANGE: r not positive, another figure negative, not a number, or the heading beyond +-1000 rad."]
    pub fn ins_unicycle_init(
        self_: *mut ins_unicycle_t,
        cfg: *const ins_unicycle_config_t,
        x: *const ins_real,
        var: *const ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "Move by dt [s] with the gyro's yaw rate [rad/s]. \\return INS_E_RANGE, nothing changed: dt not positive, or |yaw_rate dt| > 1000."]
    pub fn ins_unicycle_predict(self_: *mut ins_unicycle_t, dt: ins_real, yaw_rate: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Both sensors as inputs: move by dt [s] along the distance [m] over the odometer's scale; the speed is theirs after it. So the odometer"]
    #[doc = "says nothing about its own scale, as it does through ins_unicycle_odometer() where counts are coarse (docs/gps_dr.md)."]
    #[doc = "\\return INS_E_RANGE, nothing changed: as ins_unicycle_predict(), the distance is not a number, or the scale is not positive."]
    pub fn ins_unicycle_travel(self_: *mut ins_unicycle_t, dt: ins_real, yaw_rate: ins_real, distance: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Distance counted in the dt before. \\param[out] nis  may be 0. \\return as ins_kalman_update()."]
    pub fn ins_unicycle_odometer(self_: *mut ins_unicycle_t, dt: ins_real, distance: ins_real, nis: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Known to stand still: the gyro reads its bias, the speed is 0. \\param[in] r_speed  how sure [(m/s)^2]. \\return as above."]
    pub fn ins_unicycle_still(self_: *mut ins_unicycle_t, yaw_rate: ins_real, r_speed: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "A fix, variance r on each coordinate [m^2]. Judged as one, by its joint nis. \\return as ins_kalman_update()."]
    pub fn ins_unicycle_gps(self_: *mut ins_unicycle_t, east: ins_real, north: ins_real, r: ins_real, nis: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "What the fix would be judged by. \\param[out] nis  joint, 2 degrees of freedom. \\param[out] det  of its innovation's covariance"]
    #[doc = "[m^4]. \\return INS_E_RANGE: r is not positive, or not a number; nothing is given."]
    pub fn ins_unicycle_judge(
        self_: *const ins_unicycle_t,
        east: ins_real,
        north: ins_real,
        r: ins_real,
        nis: *mut ins_real,
        det: *mut ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "The direction of travel, of a receiver for example: clockwise from north [rad], |course| < 1000. \\param[in] r  its variance [rad^2]."]
    #[doc = "\\param[in] gate  as ins_innovation_t. \\param[out] nis  may be 0. \\return as ins_kalman_update()."]
    pub fn ins_unicycle_course(
        self_: *mut ins_unicycle_t,
        course: ins_real,
        r: ins_real,
        gate: ins_real,
        nis: *mut ins_real,
    ) -> ins_status_t;
}
#[doc = "no fix yet"]
pub const INS_GPS_DR_NONE: _bindgen_ty_7 = 0;
#[doc = "fixes; the heading is being found"]
pub const INS_GPS_DR_ALIGN: _bindgen_ty_7 = 1;
#[doc = "dead reckoning"]
pub const INS_GPS_DR_DR: _bindgen_ty_7 = 2;
pub const INS_GPS_DR_GPS: _bindgen_ty_7 = 3;
#[doc = "What the state rests on."]
pub type _bindgen_ty_7 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_dr_config_t {
    #[doc = "noise; q_speed and the gates are not used"]
    pub vehicle: ins_unicycle_config_t,
    #[doc = "its gate is for the nis of a fix with the deviation it states"]
    pub choice: ins_switch_config_t,
    #[doc = "gyro bias at the start [rad/s]"]
    pub sigma_bias: ins_real,
    #[doc = "odometer scale at the start"]
    pub sigma_scale: ins_real,
    #[doc = "correlation time of a fix's error [s]; 0: white"]
    pub tau_fix: ins_real,
    #[doc = "nis above which a fix is not used at all; 0: none"]
    pub gate_gross: ins_real,
    #[doc = "of the receiver's velocity: its course has sigma_velocity/speed [m/s]"]
    pub sigma_velocity: ins_real,
    #[doc = "speed from which the course is used [m/s]"]
    pub course_min: ins_real,
    #[doc = "standing so long, the mean yaw rate counts as one sample of the bias [s]; 0: never"]
    pub still_after: ins_real,
    #[doc = "without a fix for so long: dead reckoning [s]"]
    pub fix_max_age: ins_real,
    #[doc = "gross fixes in a row after which it starts again; 0: never"]
    pub restart: uint_least8_t,
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_dr_fix_t {
    #[doc = "[m]"]
    pub east: ins_real,
    #[doc = "[m]"]
    pub north: ins_real,
    #[doc = "of each [m]"]
    pub sigma: ins_real,
    #[doc = "how long ago it was so [s]"]
    pub age: ins_real,
    pub hdop: ins_real,
    #[doc = "clockwise from north [rad]; [m/s]"]
    pub course: ins_real,
    #[doc = "clockwise from north [rad]; [m/s]"]
    pub speed: ins_real,
    #[doc = "0: there is no fix, nothing else is read"]
    pub valid: uint_least8_t,
    #[doc = "satellites used"]
    pub sats: uint_least8_t,
    #[doc = "course and speed are known"]
    pub has_course: uint_least8_t,
}
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_gps_dr_t {
    pub cfg: ins_gps_dr_config_t,
    #[doc = "with `paired`: [0] reckons, [1] takes fixes as well"]
    pub local: [ins_unicycle_t; 8usize],
    #[doc = "of each heading, the best 1"]
    pub weight: [ins_real; 8usize],
    #[doc = "of local; 0: not started"]
    pub count: uint_least8_t,
    pub paired: uint_least8_t,
    pub choice: ins_switch_t,
    #[doc = "[s]"]
    pub since_fix: ins_real,
    #[doc = "no distance for this long, or since the last sample of the bias [s]"]
    pub stood: ins_real,
    #[doc = "in that time, as the gyro says [rad]"]
    pub turned: ins_real,
    #[doc = "of the last fix"]
    pub nis: ins_real,
    #[doc = "gross fixes in a row"]
    pub gross_run: uint_least8_t,
    #[doc = "fixes"]
    pub used: uint_least32_t,
    #[doc = "fixes that made the switch say DR"]
    pub doubted: uint_least32_t,
    #[doc = "fixes refused"]
    pub gross: uint_least32_t,
    pub restarts: uint_least32_t,
}
impl Default for ins_gps_dr_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "A car with a MEMS gyro and wheel pulses, a receiver between buildings (docs/gps_dr.md)."]
    pub fn ins_gps_dr_config_default(cfg: *mut ins_gps_dr_config_t);
}
extern "C" {
    #[doc = "\\return INS_E_RANGE: as ins_unicycle_init() and ins_switch_init() with theirs; one of the others is negative or not a number."]
    pub fn ins_gps_dr_init(self_: *mut ins_gps_dr_t, cfg: *const ins_gps_dr_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "dt [s] have passed. \\param[in] yaw_rate  clockwise, their mean [rad/s]. \\param[in] distance  counted in them [m]."]
    #[doc = "\\return INS_OK; INS_E_RANGE: dt is not positive, or one is not a number or beyond 1000 rad: nothing changed."]
    pub fn ins_gps_dr_step(self_: *mut ins_gps_dr_t, dt: ins_real, yaw_rate: ins_real, distance: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_GATE: gross, or its course was: that is not used; INS_E_RANGE: not a number, or sigma is not positive."]
    pub fn ins_gps_dr_fix(self_: *mut ins_gps_dr_t, fix: *const ins_gps_dr_fix_t) -> ins_status_t;
}
extern "C" {
    #[doc = "INS_GPS_DR_NONE ..."]
    pub fn ins_gps_dr_source(self_: *const ins_gps_dr_t) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "\\param[out] x  [6] INS_UNICYCLE_EAST ... \\param[out] P  [36]; may be 0. \\return INS_E_STATE: no fix yet."]
    pub fn ins_gps_dr_state(self_: *const ins_gps_dr_t, x: *mut ins_real, P: *mut ins_real) -> ins_status_t;
}
#[doc = "back to GPS at the first good fix, no gate of a fix, the yaw rate used at any speed"]
pub const INS_GPS_DR_PAPER_PRINTED: _bindgen_ty_8 = 0;
#[doc = "hysteresis, gate, yaw rate above 0.5 m/s only"]
pub const INS_GPS_DR_PAPER_CORRECTED: _bindgen_ty_8 = 1;
pub type _bindgen_ty_8 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_dr_paper_config_t {
    #[doc = "of east and of north"]
    pub axis: ins_gps_axis_config_t,
    pub dr: ins_dr_ekf_config_t,
    pub choice: ins_switch_config_t,
    #[doc = "of each velocity at the start [(m/s)^2]"]
    pub var_velocity: ins_real,
    #[doc = "[(m/s^2)^2]"]
    pub var_acceleration: ins_real,
}
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_gps_dr_paper_t {
    pub cfg: ins_gps_dr_paper_config_t,
    #[doc = "east, north"]
    pub axis: [ins_gps_axis_t; 2usize],
    pub dr: ins_dr_ekf_t,
    pub choice: ins_switch_t,
    pub started: uint_least8_t,
    #[doc = "of the last fix, both coordinates"]
    pub nis: ins_real,
    #[doc = "fixes"]
    pub used: uint_least32_t,
    #[doc = "by the gate of an axis, or not a number"]
    pub refused: uint_least32_t,
}
impl Default for ins_gps_dr_paper_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "Tasks of 100 ms and 1 s. \\param[in] reading  INS_GPS_DR_PAPER_PRINTED or _CORRECTED."]
    pub fn ins_gps_dr_paper_config_default(cfg: *mut ins_gps_dr_paper_config_t, reading: ::core::ffi::c_int);
}
extern "C" {
    #[doc = "\\return INS_E_RANGE: as the parts' own init."]
    pub fn ins_gps_dr_paper_init(self_: *mut ins_gps_dr_paper_t, cfg: *const ins_gps_dr_paper_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "\\return as ins_dr_ekf_step(); INS_OK before the first fix."]
    pub fn ins_gps_dr_paper_step(self_: *mut ins_gps_dr_paper_t, yaw_rate: ins_real, distance: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Sigma, age and course are not read: the paper's filters have one variance for all. \\return as ins_gps_axis_step(); INS_OK when"]
    #[doc = "the fix is not valid."]
    pub fn ins_gps_dr_paper_fix(self_: *mut ins_gps_dr_paper_t, fix: *const ins_gps_dr_fix_t) -> ins_status_t;
}
extern "C" {
    #[doc = "INS_GPS_DR_NONE, _DR or _GPS."]
    pub fn ins_gps_dr_paper_source(self_: *const ins_gps_dr_paper_t) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "\\param[out] x  [4] east, north, their velocities. \\param[out] var  [4] variances. \\return INS_E_STATE: no fix yet."]
    pub fn ins_gps_dr_paper_state(self_: *const ins_gps_dr_paper_t, x: *mut ins_real, var: *mut ins_real) -> ins_status_t;
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_markov_t {
    #[doc = "transition over one step"]
    pub phi: ins_real,
    #[doc = "variance that a step adds"]
    pub q: ins_real,
}
extern "C" {
    #[doc = "\\param[in] dt  step [s], >= 0. \\param[in] tau  time constant [s], > 0. \\param[in] sigma  standard deviation of x, >= 0."]
    #[doc = "\\return INS_E_RANGE, and self unchanged, if one is not, or not a number."]
    pub fn ins_markov_init(self_: *mut ins_markov_t, dt: ins_real, tau: ins_real, sigma: ins_real) -> ins_status_t;
}
#[doc = "attitude, in n [rad]"]
pub const INS_KF15_PHI: _bindgen_ty_9 = 0;
#[doc = "velocity, in n [m/s]"]
pub const INS_KF15_V: _bindgen_ty_9 = 3;
#[doc = "position, north, east, down [m]"]
pub const INS_KF15_P: _bindgen_ty_9 = 6;
#[doc = "gyro bias, in b [rad/s]"]
pub const INS_KF15_BG: _bindgen_ty_9 = 9;
#[doc = "accelerometer bias, in b [m/s^2]"]
pub const INS_KF15_BA: _bindgen_ty_9 = 12;
#[doc = "Where three errors begin."]
pub type _bindgen_ty_9 = ::core::ffi::c_uint;
#[doc = "Owned by the caller; readable. Start with ins_kf15_init()."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_kf15_t {
    #[doc = "symmetric; P(i,j) at INS_KF15_ROW i + j"]
    pub P: [ins_real; 240usize],
    #[doc = "gain of the last update that was not refused"]
    pub K: [ins_real; 16usize],
}
impl Default for ins_kf15_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[doc = "The same as P = U D U'. Start with ins_kf15_ud_init()."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_kf15_ud_t {
    #[doc = "by columns: U(i,j) at INS_KF15_ROW j + i; 1 on the diagonal, 0 below"]
    pub U: [ins_real; 240usize],
    pub D: [ins_real; 15usize],
    #[doc = "as in ins_kf15_t"]
    pub K: [ins_real; 16usize],
}
impl Default for ins_kf15_ud_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[doc = "What the sensors add."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_kf15_sensors_t {
    #[doc = "angle random walk [rad/sqrt(s)]"]
    pub arw: ins_real,
    #[doc = "velocity random walk [m/s/sqrt(s)]"]
    pub vrw: ins_real,
    #[doc = "gyro bias: Gauss-Markov, standard deviation [rad/s]"]
    pub bg_sigma: ins_real,
    #[doc = "its time constant [s]"]
    pub bg_tau: ins_real,
    #[doc = "accelerometer bias [m/s^2]"]
    pub ba_sigma: ins_real,
    #[doc = "[s]"]
    pub ba_tau: ins_real,
}
#[doc = "F dt and Q of one step. Start with ins_kf15_model_init(). Members are private."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_kf15_model_t {
    #[doc = "C_nb dt [s]"]
    pub C: [ins_real; 9usize],
    #[doc = "w_in_n dt [rad]"]
    pub turn: [ins_real; 3usize],
    #[doc = "f_n dt [m/s]"]
    pub dv: [ins_real; 3usize],
    #[doc = "-dt/(R_N + h), dt/(R_M + h), dt tan(lat)/(R_N + h) [s/m]"]
    pub curve: [ins_real; 3usize],
    #[doc = "d dv / d v by rows; in place of its last element, which is 0, 2 g dt/R [1/s]"]
    pub coriolis: [ins_real; 9usize],
    #[doc = "[s]"]
    pub dt: ins_real,
    #[doc = "[rad^2]"]
    pub q_phi: ins_real,
    #[doc = "[m^2/s^2]"]
    pub q_v: ins_real,
    pub bg: ins_markov_t,
    pub ba: ins_markov_t,
}
extern "C" {
    #[doc = "\\param[in] sigma  [15] standard deviations of the start. \\return INS_OK; INS_E_RANGE: one is negative or not a number."]
    pub fn ins_kf15_init(self_: *mut ins_kf15_t, sigma: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] dt  of one step [s], > 0. \\return INS_OK; INS_E_RANGE: dt, a noise or a time constant is out of range (those from dt)."]
    pub fn ins_kf15_model_init(self_: *mut ins_kf15_model_t, dt: ins_real, sensors: *const ins_kf15_sensors_t) -> ins_status_t;
}
extern "C" {
    #[doc = "F dt of the step that ended at `at`. \\param[in] at  attitude, velocity and position. \\param[in] v_b  [3] of that step [m/s]."]
    pub fn ins_kf15_model(self_: *mut ins_kf15_model_t, at: *const ins_strapdown_t, v_b: *const ins_real);
}
extern "C" {
    #[doc = "I + F dt, for a smoother. \\param[out] Phi  [15 15]"]
    pub fn ins_kf15_transition(self_: *const ins_kf15_model_t, Phi: *mut ins_real);
}
extern "C" {
    #[doc = "P = (I + F dt) P (I + F dt)' + Q."]
    pub fn ins_kf15_propagate(self_: *mut ins_kf15_t, model: *const ins_kf15_model_t);
}
extern "C" {
    #[doc = "One scalar z = h x + noise; what K v corrects is the caller's. \\param[in] h  [15]; zeros cost nothing."]
    #[doc = "\\return INS_OK, self->K is the gain; INS_E_GATE: outside the gate; INS_E_RANGE: v or h P h' is not a number, or r is not"]
    #[doc = "positive. Refused means that self is unchanged."]
    pub fn ins_kf15_update(self_: *mut ins_kf15_t, h: *const ins_real, z: *mut ins_innovation_t) -> ins_status_t;
}
extern "C" {
    #[doc = "The same for h = 1 at index, 0 elsewhere. \\return also INS_E_RANGE for an index above 14."]
    pub fn ins_kf15_update_state(self_: *mut ins_kf15_t, index: ::core::ffi::c_uint, z: *mut ins_innovation_t) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_kf15_init()."]
    pub fn ins_kf15_ud_init(self_: *mut ins_kf15_ud_t, sigma: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_kf15_propagate(), on the factors: the nine navigation rows by weighted Gram-Schmidt, the noise of each bias by a"]
    #[doc = "rank-one change."]
    pub fn ins_kf15_ud_propagate(self_: *mut ins_kf15_ud_t, model: *const ins_kf15_model_t);
}
extern "C" {
    #[doc = "As ins_kf15_update() (Bierman)."]
    pub fn ins_kf15_ud_update(self_: *mut ins_kf15_ud_t, h: *const ins_real, z: *mut ins_innovation_t) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_kf15_update_state()."]
    pub fn ins_kf15_ud_update_state(self_: *mut ins_kf15_ud_t, index: ::core::ffi::c_uint, z: *mut ins_innovation_t) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] P  [INS_KF15_N INS_KF15_ROW] as in ins_kf15_t."]
    pub fn ins_kf15_ud_covariance(self_: *const ins_kf15_ud_t, P: *mut ins_real);
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_still_config_t {
    #[doc = "of a block; 0: never at rest"]
    pub samples: u16,
    #[doc = "largest standard deviation of an axis within a block [rad/s]"]
    pub rate_sigma: ins_real,
    #[doc = "[m/s^2]"]
    pub force_sigma: ins_real,
    #[doc = "largest mean of an axis [rad/s]"]
    pub rate_mean: ins_real,
}
#[doc = "Owned by the caller. Start with ins_still_init(); rate and force are readable."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_still_t {
    pub cfg: ins_still_config_t,
    pub count: u16,
    #[doc = "of the block: sums are taken from it, so that they do not cancel"]
    pub first: [ins_real; 6usize],
    pub sum: [ins_real; 6usize],
    pub squares: [ins_real; 6usize],
    #[doc = "means of the last block of rest [rad/s], [m/s^2]"]
    pub rate: [ins_real; 3usize],
    #[doc = "means of the last block of rest [rad/s], [m/s^2]"]
    pub force: [ins_real; 3usize],
}
extern "C" {
    #[doc = "\\return INS_E_RANGE, self unchanged: samples 1, or with samples a bound that is not positive."]
    pub fn ins_still_init(self_: *mut ins_still_t, cfg: *const ins_still_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] increment  finite, of the last dt > 0 [s]. \\return 1 at the end of a block of rest, else 0."]
    pub fn ins_still_add(self_: *mut ins_still_t, dt: ins_real, increment: *const ins_increment_t) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "After lost samples: a new block."]
    pub fn ins_still_restart(self_: *mut ins_still_t);
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_config_t {
    #[doc = "random walks and Gauss-Markov biases of the IMU"]
    pub sensors: ins_kf15_sensors_t,
    #[doc = "rms of a motion that a gap or a dead axis hides [rad/s], [m/s^2]"]
    pub unseen_rate: ins_real,
    #[doc = "rms of a motion that a gap or a dead axis hides [rad/s], [m/s^2]"]
    pub unseen_accel: ins_real,
    #[doc = "of the IMU's ranges; beyond: refused [rad/s], [m/s^2]"]
    pub rate_max: ins_real,
    #[doc = "of the IMU's ranges; beyond: refused [rad/s], [m/s^2]"]
    pub force_max: ins_real,
    #[doc = "longest time without IMU that is bridged [s]"]
    pub gap_max: ins_real,
    #[doc = "samples of one value that make an axis dead; 0: not looked at"]
    pub stuck: u16,
    #[doc = "IMU samples to a step of the covariance, at least 1"]
    pub decimate: u16,
    #[doc = "from the IMU [m]"]
    pub antenna_b: [ins_real; 3usize],
    #[doc = "added to the time of a fix, within +-INS_GPS_INS_DELAY_MAX [s]"]
    pub gnss_late: ins_real,
    #[doc = "of the joint NIS of 3; 0: none"]
    pub gate_position: ins_real,
    #[doc = "of the joint NIS of 3; 0: none"]
    pub gate_velocity: ins_real,
    #[doc = "of one scalar; 0: none"]
    pub gate: ins_real,
    #[doc = "fixes refused in a row after which the filter doubts itself; 0: never"]
    pub refused_max: u16,
    #[doc = "from the IMU to the point that only rolls forward, the rear axle [m]"]
    pub wheel_b: [ins_real; 3usize],
    #[doc = "standard deviations of no slip, of rest [m/s], of no turning [rad/s]"]
    pub nhc: ins_real,
    #[doc = "standard deviations of no slip, of rest [m/s], of no turning [rad/s]"]
    pub zupt: ins_real,
    #[doc = "standard deviations of no slip, of rest [m/s], of no turning [rad/s]"]
    pub zaru: ins_real,
    #[doc = "detector of rest: zupt and zaru by themselves"]
    pub still: ins_still_config_t,
}
#[doc = "Where it starts. sigma: as ins/kf15.h orders the states."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_start_t {
    pub t_ns: i64,
    pub q_nb: [ins_real; 4usize],
    pub v_n: [ins_real; 3usize],
    #[doc = "of the IMU"]
    pub position: ins_position_t,
    pub gyro_bias: [ins_real; 3usize],
    pub accel_bias: [ins_real; 3usize],
    pub sigma: [ins_real; 15usize],
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_count_t {
    pub steps: u32,
    pub imu_refused: u32,
    pub imu_time: u32,
    pub imu_clock: u32,
    pub imu_gaps: u32,
    pub imu_stuck: u32,
    pub fixes: u32,
    pub fix_refused: u32,
    pub fix_time: u32,
    pub fix_position: u32,
    pub fix_velocity: u32,
    pub fix_doubts: u32,
    pub rests: u32,
    pub rest_refused: u32,
    pub aid_refused: u32,
}
#[doc = "The answer with its covariance: blocks of P, row-major, north, east, down."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_state_t {
    pub t_ns: i64,
    pub q_nb: [ins_real; 4usize],
    pub v_n: [ins_real; 3usize],
    pub position: ins_position_t,
    pub gyro_bias: [ins_real; 3usize],
    pub accel_bias: [ins_real; 3usize],
    #[doc = "attitude [rad^2], velocity [m^2/s^2], position [m^2]"]
    pub P_phi: [ins_real; 9usize],
    #[doc = "attitude [rad^2], velocity [m^2/s^2], position [m^2]"]
    pub P_v: [ins_real; 9usize],
    #[doc = "attitude [rad^2], velocity [m^2/s^2], position [m^2]"]
    pub P_p: [ins_real; 9usize],
    pub sigma: [ins_real; 15usize],
}
#[doc = "What is known of them before. A standard deviation of 0: there is none, and none is estimated."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_kf15_scale_sensors_t {
    #[doc = "0.01: a hundredth; up to INS_KF15_SCALE_MAX"]
    pub gyro_sigma: ins_real,
    #[doc = "0.01: a hundredth; up to INS_KF15_SCALE_MAX"]
    pub accel_sigma: ins_real,
    #[doc = "time constants [s], at least INS_STRAPDOWN_PERIOD_MAX; 1e6: all but constant"]
    pub gyro_tau: ins_real,
    #[doc = "time constants [s], at least INS_STRAPDOWN_PERIOD_MAX; 1e6: all but constant"]
    pub accel_tau: ins_real,
}
#[doc = "Owned by the caller; readable. Start with ins_kf15_scale_init()."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_kf15_scale_t {
    #[doc = "of state i, 15 to 20 being s, with s j: at 6 i + j"]
    pub B: [ins_real; 126usize],
    #[doc = "gain of the last update that was not refused"]
    pub K: [ins_real; 6usize],
    pub sensors: ins_kf15_scale_sensors_t,
}
impl Default for ins_kf15_scale_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "Not correlated with anything yet. \\return INS_E_RANGE, self unchanged: a figure is out of its range, or not a number."]
    pub fn ins_kf15_scale_init(self_: *mut ins_kf15_scale_t, sensors: *const ins_kf15_scale_sensors_t) -> ins_status_t;
}
extern "C" {
    #[doc = "One step of all 21. \\param[in,out] kf  as by ins_kf15_propagate()."]
    #[doc = "\\param[in] theta_b, v_b  [3] of the step, as ins_kf15_model() was told [rad], [m/s]."]
    pub fn ins_kf15_scale_propagate(
        self_: *mut ins_kf15_scale_t,
        kf: *mut ins_kf15_t,
        model: *const ins_kf15_model_t,
        theta_b: *const ins_real,
        v_b: *const ins_real,
    );
}
extern "C" {
    #[doc = "One scalar z = h x + h_s s + noise. \\param[in] h  [15]; one of it at least is not 0. \\param[in] h_s  [6] gyros, accelerometers."]
    #[doc = "\\return as ins_kf15_update(); kf->K and self->K are the gain."]
    pub fn ins_kf15_scale_update(
        self_: *mut ins_kf15_scale_t,
        kf: *mut ins_kf15_t,
        h: *const ins_real,
        h_s: *const ins_real,
        z: *mut ins_innovation_t,
    ) -> ins_status_t;
}
#[doc = "Where the antenna was, for fixes that come late."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_past_t {
    pub t_ns: i64,
    #[doc = "from a common point [m]"]
    pub u_n: [ins_real; 3usize],
    #[doc = "[m/s]"]
    pub v_n: [ins_real; 3usize],
}
#[doc = "The last fix beside the filter: north, east, down of position, then of velocity."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_check_t {
    #[doc = "fix - filter [m], [m/s]"]
    pub innovation: [ins_real; 6usize],
    #[doc = "of each alone, given those before it; 0: not used"]
    pub nis: [ins_real; 6usize],
    #[doc = "joint, of the components known"]
    pub nis_position: ins_real,
    #[doc = "joint, of the components known"]
    pub nis_velocity: ins_real,
}
#[doc = "Owned by the caller. Start with ins_gps_ins_init(); read nav (attitude, velocity, position), biases, kf, check, count, stuck."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_gps_ins_t {
    pub cfg: ins_gps_ins_config_t,
    pub nav: ins_strapdown_t,
    pub gyro_bias: [ins_real; 3usize],
    pub accel_bias: [ins_real; 3usize],
    pub kf: ins_kf15_t,
    #[doc = "of the covariance's last step"]
    pub model: ins_kf15_model_t,
    pub check: ins_gps_ins_check_t,
    pub count: ins_gps_ins_count_t,
    pub still: ins_still_t,
    #[doc = "bit i: axis i of the gyros, i - 3 of the accelerometers, is dead"]
    pub stuck: uint_least8_t,
    #[doc = "1 after a gap longer than gap_max: start again"]
    pub lost: uint_least8_t,
    #[doc = "of the last sample used"]
    pub t_ns: i64,
    #[doc = "of the last sample [s]"]
    pub dt: ins_real,
    #[doc = "its rate, biases taken off [rad/s]"]
    pub w_ib_b: [ins_real; 3usize],
    #[doc = "rates and specific forces as they came"]
    pub value: [ins_real; 6usize],
    #[doc = "samples in a row without a change"]
    pub same: [u16; 6usize],
    #[doc = "samples since the covariance's last step"]
    pub pending: u16,
    #[doc = "[s]"]
    pub pending_dt: ins_real,
    #[doc = "specific force integrated over them [m/s]"]
    pub pending_v: [ins_real; 3usize],
    #[doc = "of the last sample that did not follow in time"]
    pub odd_t_ns: i64,
    #[doc = "of those, in a row"]
    pub odd: u16,
    #[doc = "fixes, in a row"]
    pub refused: u16,
    #[doc = "from the common point of past [m]"]
    pub way_n: [ins_real; 3usize],
    pub past: [ins_gps_ins_past_t; 8usize],
    pub newest: uint_least8_t,
    pub held: uint_least8_t,
    #[doc = "1: model holds cfg.sensors alone"]
    pub plain: uint_least8_t,
    #[doc = "what it is the base of"]
    pub form: uint_least8_t,
}
impl Default for ins_gps_ins_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[doc = "The same with the covariance as P = U D U', for float with P0/R above 1e8. Start with ins_gps_ins_ud_init(); base goes to all"]
#[doc = "other functions, base.kf.P is the covariance at the last measurement."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_gps_ins_ud_t {
    pub base: ins_gps_ins_t,
    pub ud: ins_kf15_ud_t,
}
impl Default for ins_gps_ins_ud_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
#[doc = "The same with scale factors. Start with ins_gps_ins_scale_init(); base goes to all other functions. Read gyro, accel; kf has"]
#[doc = "their covariance, 0.01 of standard deviation: a hundredth."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_gps_ins_scale_t {
    pub base: ins_gps_ins_t,
    pub kf: ins_kf15_scale_t,
    #[doc = "a sensor reads (1 + this) times the truth, and its bias"]
    pub gyro: [ins_real; 3usize],
    #[doc = "a sensor reads (1 + this) times the truth, and its bias"]
    pub accel: [ins_real; 3usize],
    #[doc = "angle since the covariance's last step [rad]"]
    pub pending_theta: [ins_real; 3usize],
    pub moved: [ins_real; 6usize],
}
impl Default for ins_gps_ins_scale_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "A low-cost MEMS IMU (0.3 deg/sqrt(h), 0.1 m/s/sqrt(h), 0.1 deg/s and 50 mg/1000 s), an antenna at the IMU, gates of 99.9 %,"]
    #[doc = "no detector of rest."]
    pub fn ins_gps_ins_config(cfg: *mut ins_gps_ins_config_t);
}
extern "C" {
    #[doc = "Begins where start says."]
    #[doc = "\\return INS_E_RANGE, self unchanged: a figure is out of its range, or sigma of an angle above INS_GPS_INS_TILT_MAX: that far"]
    #[doc = "off an error filter is not linear, and would be sure of a wrong heading; ins/gps_ins_align.h finds it."]
    pub fn ins_gps_ins_init(self_: *mut ins_gps_ins_t, cfg: *const ins_gps_ins_config_t, start: *const ins_gps_ins_start_t)
        -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_gps_ins_init()."]
    pub fn ins_gps_ins_ud_init(
        self_: *mut ins_gps_ins_ud_t,
        cfg: *const ins_gps_ins_config_t,
        start: *const ins_gps_ins_start_t,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_gps_ins_init(); scale factors begin at 0. \\return INS_E_RANGE also for what ins_kf15_scale_init() refuses."]
    pub fn ins_gps_ins_scale_init(
        self_: *mut ins_gps_ins_scale_t,
        cfg: *const ins_gps_ins_config_t,
        sensors: *const ins_kf15_scale_sensors_t,
        start: *const ins_gps_ins_start_t,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "Next IMU sample."]
    #[doc = "\\param[in] t_ns  end of the interval, any time base, within +-INS_GNSS_TIME_MAX_NS. \\param[in] dt  its length [s]."]
    #[doc = "\\return INS_OK; INS_E_RANGE: not a number, out of range, or its time does not follow: not used; INS_E_STATE: lost."]
    pub fn ins_gps_ins_step(self_: *mut ins_gps_ins_t, t_ns: i64, dt: ins_real, increment: *const ins_increment_t) -> ins_status_t;
}
extern "C" {
    #[doc = "Position and velocity are judged apart. \\return INS_OK: at least one was used; INS_E_GATE: none; INS_E_RANGE: not a number, no"]
    #[doc = "sigma, or a time that the past does not reach."]
    pub fn ins_gps_ins_gnss(self_: *mut ins_gps_ins_t, fix: *const ins_gnss_fix_t) -> ins_status_t;
}
extern "C" {
    #[doc = "At rest now. \\return INS_OK; INS_E_GATE."]
    pub fn ins_gps_ins_zupt(self_: *mut ins_gps_ins_t) -> ins_status_t;
}
extern "C" {
    #[doc = "Not turning over the last time. \\param[in] w_ib_b  [3] mean rate as the IMU gave it, bias and all [rad/s]."]
    pub fn ins_gps_ins_zaru(self_: *mut ins_gps_ins_t, w_ib_b: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "No velocity across the wheels, sideways or up, at cfg.wheel_b: non-holonomic constraint."]
    pub fn ins_gps_ins_nhc(self_: *mut ins_gps_ins_t) -> ins_status_t;
}
extern "C" {
    #[doc = "Forward speed of cfg.wheel_b [m/s], and its standard deviation."]
    pub fn ins_gps_ins_odometer(self_: *mut ins_gps_ins_t, speed: ins_real, sigma: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Rate of heading, right turn positive, of another gyro, over the last IMU sample [rad/s]."]
    pub fn ins_gps_ins_yaw_rate(self_: *mut ins_gps_ins_t, rate: ins_real, sigma: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Height of the IMU above the ellipsoid, of a barometer or a map [m]."]
    pub fn ins_gps_ins_altitude(self_: *mut ins_gps_ins_t, height: ins_real, sigma: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "The answer and how sure it is, of the last sample and measurement."]
    pub fn ins_gps_ins_state(self_: *const ins_gps_ins_t, state: *mut ins_gps_ins_state_t);
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_align_config_t {
    #[doc = "standard deviation that is good enough, up to INS_GPS_INS_TILT_MAX [rad]"]
    pub heading_max: ins_real,
    #[doc = "of the accelerations [s]; the gyros' bias turns them meanwhile"]
    pub memory: ins_real,
    #[doc = "from which on the nose points along the velocity [m/s]; 0: it need not"]
    pub course_speed: ins_real,
    #[doc = "how well [rad]"]
    pub course_sigma: ins_real,
}
#[doc = "Owned by the caller. Start with ins_gps_ins_align_init(); gyro_bias is readable. Members are private."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gps_ins_align_t {
    pub sensors: ins_kf15_sensors_t,
    pub how: ins_gps_ins_align_config_t,
    pub antenna_b: [ins_real; 3usize],
    #[doc = "of the last rest [rad/s]"]
    pub gyro_bias: [ins_real; 3usize],
    #[doc = "[rad/s]"]
    pub bg_sigma: ins_real,
    pub still: ins_still_t,
    #[doc = "attitude against that at the last fix"]
    pub turned: ins_sculling_t,
    #[doc = "specific force integrated since, in b as it stood then [m/s]"]
    pub felt: [ins_real; 3usize],
    #[doc = "of the last sample [s]"]
    pub dt: ins_real,
    #[doc = "time of felt [s]"]
    pub felt_s: ins_real,
    #[doc = "of the last sample"]
    pub t_ns: i64,
    #[doc = "of the last fix [m/s]"]
    pub v_n: [ins_real; 3usize],
    #[doc = "1: v_n and felt are good"]
    pub has_fix: uint_least8_t,
    #[doc = "1: the last fix had no velocity; a steady drive looks like rest to an IMU"]
    pub rests: uint_least8_t,
    #[doc = "sum of w n b', rows n"]
    pub M: [ins_real; 9usize],
    #[doc = "of what was felt"]
    pub sum_b: [ins_real; 3usize],
    #[doc = "of what it must have been"]
    pub sum_n: [ins_real; 3usize],
    #[doc = "sum of w n n', less what is noise in it [1/rad^2]"]
    pub S: [ins_real; 9usize],
    #[doc = "sum of w e^2, e the most that biases bend what was felt"]
    pub bent: ins_real,
    #[doc = "the nose when its direction was known"]
    pub nose_b: [ins_real; 3usize],
    #[doc = "that direction, horizontal"]
    pub nose_n: [ins_real; 3usize],
    #[doc = "0: not known [rad]"]
    pub nose_sigma: ins_real,
}
extern "C" {
    #[doc = "heading_max 0.2 rad, memory 20 s, course of a vehicle from 3 m/s within 0.05 rad."]
    pub fn ins_gps_ins_align_config(how: *mut ins_gps_ins_align_config_t);
}
extern "C" {
    #[doc = "\\param[in] cfg  of the filter to start: sensors, antenna, detector of rest. \\return INS_E_RANGE, self unchanged."]
    pub fn ins_gps_ins_align_init(
        self_: *mut ins_gps_ins_align_t,
        cfg: *const ins_gps_ins_config_t,
        how: *const ins_gps_ins_align_config_t,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "Next IMU sample, as ins_gps_ins_step(). After a gap the accelerations begin anew."]
    #[doc = "\\return INS_OK; INS_E_RANGE: not a number, or its time does not follow."]
    pub fn ins_gps_ins_align_step(
        self_: *mut ins_gps_ins_align_t,
        t_ns: i64,
        dt: ins_real,
        increment: *const ins_increment_t,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "Heading of the nose from who knows it: a compass, two antennas, a map [rad]."]
    #[doc = "\\return INS_E_RANGE: not a number, |heading| > 2 pi, or no sigma."]
    pub fn ins_gps_ins_align_heading(self_: *mut ins_gps_ins_align_t, heading: ins_real, sigma: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "A fix of position and velocity, at most 0.1 s late. \\param[out] start  if INS_OK."]
    #[doc = "\\return INS_OK: this is where it starts; INS_S_START: not known yet; INS_E_RANGE: not such a fix."]
    pub fn ins_gps_ins_align_gnss(
        self_: *mut ins_gps_ins_align_t,
        fix: *const ins_gnss_fix_t,
        start: *mut ins_gps_ins_start_t,
    ) -> ins_status_t;
}
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_accel_t {
    #[doc = "in units of the reading"]
    pub bias: ins_real,
    #[doc = "reading per m/s^2, in b"]
    pub axis: [ins_real; 3usize],
    #[doc = "place [m], in b"]
    pub r: [ins_real; 3usize],
}
#[doc = "Geometry, and the state of the rate's integration. Owned by the caller."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_sixacc_t {
    pub count: uint_least8_t,
    pub started: uint_least8_t,
    pub period_s: ins_real,
    pub bias: [ins_real; 12usize],
    #[doc = "readings less biases -> wd, f"]
    pub inverse: [[ins_real; 12usize]; 6usize],
    #[doc = "wx wx, wy wy, wz wz, wx wy, wx wz, wy wz -> what they add to wd, f"]
    pub product: [[ins_real; 6usize]; 6usize],
    #[doc = "rate at the last sample [rad/s]; set it to start with a known one"]
    pub w_ib_b: [ins_real; 3usize],
    #[doc = "inverse times the last sample"]
    pub linear: [ins_real; 6usize],
    #[doc = "angular acceleration at the last sample [rad/s^2]"]
    pub wd_ib_b: [ins_real; 3usize],
}
extern "C" {
    #[doc = "The paper's six, arm rho [m]. \\param[out] accels  [6]."]
    pub fn ins_sixacc_paper(rho: ins_real, accels: *mut ins_accel_t);
}
extern "C" {
    #[doc = "A reading without its accelerometer's quadratic term, which `ins calib` finds: for bias + s (x + k2 x^2) it is bias + s x, with s"]
    #[doc = "the length of the axis. Where k2 matters, each reading goes through it before the rest of this header; it is one square root."]
    #[doc = "\\param[in] k2  [s^2/m]. \\return of a reading beyond the parabola's turn, that of the turn."]
    pub fn ins_accel_linear(accel: *const ins_accel_t, k2: ins_real, reading: ins_real) -> ins_real;
}
extern "C" {
    #[doc = "Rate 0. \\return INS_OK; INS_E_RANGE unless 6 <= count <= INS_SIXACC_MAX, period_s > 0, all numbers finite and the six unknowns"]
    #[doc = "observable."]
    pub fn ins_sixacc_init(
        self_: *mut ins_sixacc_t,
        count: ::core::ffi::c_uint,
        accels: *const ins_accel_t,
        period_s: ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "One instant, for a known rate. \\param[in] readings  [count]. \\param[out] wd_ib_b  [3] [rad/s^2]. \\param[out] f_b  [3] [m/s^2]."]
    pub fn ins_sixacc_resolve(
        self_: *const ins_sixacc_t,
        readings: *const ins_real,
        w_ib_b: *const ins_real,
        wd_ib_b: *mut ins_real,
        f_b: *mut ins_real,
    );
}
extern "C" {
    #[doc = "Next sample: rate by the trapezoid of the angular acceleration, products of the rate taken at mid-interval."]
    #[doc = "\\param[in] readings  [count]. \\param[out] increment  over the last period; zero for the first sample."]
    #[doc = "\\return INS_OK; INS_S_START for the first sample; INS_E_RANGE for NaN or infinity, and then self is unchanged."]
    pub fn ins_sixacc_step(self_: *mut ins_sixacc_t, readings: *const ins_real, increment: *mut ins_increment_t) -> ins_status_t;
}
#[doc = "Linear map of accelerometers from readings in known attitudes: P = map[0] + map[1..3] . a, by least squares on [1, a], taken in"]
#[doc = "row by row with Givens rotations (no normal equations: float keeps its digits). The memory is the caller's, whatever the rows."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_linfit_t {
    #[doc = "accelerometers"]
    pub count: uint_least8_t,
    #[doc = "upper triangle"]
    pub R: [ins_real; 16usize],
    #[doc = "right-hand sides"]
    pub z: [ins_real; 48usize],
    #[doc = "sum of squared residuals"]
    pub residual2: [ins_real; 12usize],
}
impl Default for ins_linfit_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE unless 1 <= count <= INS_SIXACC_MAX."]
    pub fn ins_linfit_init(self_: *mut ins_linfit_t, count: ::core::ffi::c_uint) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] f_b  [3] specific force [m/s^2]. \\param[in] readings  [count]. \\return INS_OK; INS_E_RANGE for NaN, unchanged."]
    pub fn ins_linfit_add(self_: *mut ins_linfit_t, f_b: *const ins_real, readings: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] map  [4] of accelerometer `index`: bias, axis. \\return INS_OK; INS_E_STATE while the attitudes seen do not fix it;"]
    #[doc = "INS_E_RANGE for a wrong index."]
    pub fn ins_linfit_solve(self_: *const ins_linfit_t, index: ::core::ffi::c_uint, map: *mut ins_real) -> ins_status_t;
}
#[doc = "attitude, in n [rad]"]
pub const INS_GYRO_FREE_PHI: _bindgen_ty_10 = 0;
#[doc = "velocity, in n [m/s]"]
pub const INS_GYRO_FREE_V: _bindgen_ty_10 = 3;
#[doc = "position, north, east, down [m]"]
pub const INS_GYRO_FREE_P: _bindgen_ty_10 = 6;
#[doc = "rate, in b [rad/s]"]
pub const INS_GYRO_FREE_W: _bindgen_ty_10 = 9;
#[doc = "of the angular acceleration, in b [rad/s^2]"]
pub const INS_GYRO_FREE_BD: _bindgen_ty_10 = 12;
#[doc = "of the specific force, in b [m/s^2]"]
pub const INS_GYRO_FREE_BF: _bindgen_ty_10 = 15;
#[doc = "Where three errors begin."]
pub type _bindgen_ty_10 = ::core::ffi::c_uint;
#[doc = "Standard deviations; those of the readings are alike for all accelerometers, in m/s^2."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_gyro_free_config_t {
    #[doc = "of a reading, quantisation included, > 0"]
    pub noise: ins_real,
    #[doc = "of a reading's bias at the start"]
    pub bias: ins_real,
    #[doc = "its growth [m/s^2/sqrt(s)]"]
    pub bias_walk: ins_real,
    #[doc = "at the start, about north, east, down [rad]"]
    pub attitude: [ins_real; 3usize],
    #[doc = "each axis [m/s]"]
    pub velocity: ins_real,
    #[doc = "each axis [m]"]
    pub position: ins_real,
    #[doc = "each axis [rad/s]"]
    pub rate: ins_real,
    #[doc = "an innovation's v^2 / variance above it is refused: INS_KALMAN_GATE_999 is good; 0: none"]
    pub gate: ins_real,
}
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_gyro_free_t {
    pub cfg: ins_gyro_free_config_t,
    #[doc = "its biases are the estimated ones"]
    pub sixacc: ins_sixacc_t,
    pub strapdown: ins_strapdown_t,
    #[doc = "reading of an angular acceleration and a specific force"]
    pub forward: [[ins_real; 6usize]; 12usize],
    #[doc = "covariance of these two for readings of variance 1"]
    pub noise: [[ins_real; 6usize]; 6usize],
    pub UD: [ins_real; 171usize],
    #[doc = "innovations outside the gate"]
    pub refused: u32,
}
impl Default for ins_gyro_free_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "At rate 0. \\return INS_OK; INS_E_RANGE for what ins_sixacc_init() and ins_strapdown_init() refuse, a noise that is not positive, or"]
    #[doc = "another figure that is negative or not a number."]
    pub fn ins_gyro_free_init(
        self_: *mut ins_gyro_free_t,
        cfg: *const ins_gyro_free_config_t,
        count: ::core::ffi::c_uint,
        accels: *const ins_accel_t,
        period_s: ins_real,
        q_nb: *const ins_real,
        v_n: *const ins_real,
        position: *const ins_position_t,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "Next sample. \\param[in] readings  [count]. \\return INS_OK; INS_S_START for the first sample, which moves nothing; INS_E_RANGE as"]
    #[doc = "ins_sixacc_step() and ins_strapdown_step(); nothing is changed then."]
    pub fn ins_gyro_free_step(self_: *mut ins_gyro_free_t, readings: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "A fix of the antenna's position at the last sample. Each axis is judged by itself."]
    #[doc = "\\param[in] sigma  [3] north, east, down [m]. \\param[in] l_b  [3] from the IMU to the antenna [m]."]
    #[doc = "\\return INS_OK; INS_E_GATE: an axis was outside the gate (the others count); INS_E_RANGE for NaN or a sigma that is not positive."]
    pub fn ins_gyro_free_position(
        self_: *mut ins_gyro_free_t,
        fix: *const ins_position_t,
        sigma: *const ins_real,
        l_b: *const ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "A known velocity. \\param[in] sigma  [3] [m/s]. \\return as ins_gyro_free_position()."]
    pub fn ins_gyro_free_velocity(self_: *mut ins_gyro_free_t, v_n: *const ins_real, sigma: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Known to stand still: the velocity is 0 and the rate that of the Earth. What calibrates dbd, at every sample of a standstill."]
    #[doc = "\\param[in] sigma_v  [m/s]. \\param[in] sigma_w  [rad/s]. \\return as ins_gyro_free_position()."]
    pub fn ins_gyro_free_still(self_: *mut ins_gyro_free_t, sigma_v: ins_real, sigma_w: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] sigma  [INS_GYRO_FREE_N] standard deviations of the errors."]
    pub fn ins_gyro_free_sigma(self_: *const ins_gyro_free_t, sigma: *mut ins_real);
}
#[doc = "Both sides take one; a member that the other side alone uses may be 0. reply_timeout must be longer than octet_timeout and one"]
#[doc = "exchange of octets, so that the host is back in idle when the board asks again."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_hs_config_t {
    #[doc = "1..INS_HS_BLOCK_MAX octets; at least 4 with seq"]
    pub block_len: uint_least8_t,
    #[doc = "1: sequence number in the spare high nibbles of X and Y"]
    pub seq: uint_least8_t,
    #[doc = "board: frames and requests sent again for one block; host: FFs, less one, for one request"]
    pub retries: uint_least8_t,
    #[doc = "board: wait for BB, 00 or FF, from when ins_hs_board_tx() gave the octet before"]
    pub reply_timeout: u16,
    #[doc = "host: longest silence inside a block"]
    pub octet_timeout: u16,
}
#[doc = "Board side (A). Start with ins_hs_board_init(). Members are private, the counters readable."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_hs_board_t {
    pub cfg: ins_hs_config_t,
    pub state: uint_least8_t,
    pub tries: uint_least8_t,
    #[doc = "next octet of the frame to transmit"]
    pub next: uint_least8_t,
    pub sum: uint_least8_t,
    pub since: u16,
    pub block: [ins_octet_t; 32usize],
    #[doc = "blocks acknowledged with 00"]
    pub sent: u16,
    #[doc = "frames or requests sent again, after FF or a time-out"]
    pub resent: u16,
    #[doc = "blocks dropped after the last retry"]
    pub given_up: u16,
}
extern "C" {
    #[doc = "Nothing on its way, counters 0. \\return INS_OK; INS_E_RANGE for a cfg that ins_hs_config_t does not allow."]
    pub fn ins_hs_board_init(self_: *mut ins_hs_board_t, cfg: *const ins_hs_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "Offer a block for transmission, with its sequence number (ignored with cfg.seq = 0)."]
    #[doc = "\\return INS_OK; INS_E_STATE while an earlier block is on its way (nothing changed; see ins_hs_board_busy)."]
    pub fn ins_hs_board_offer(self_: *mut ins_hs_board_t, block: *const ins_octet_t, seq: uint_least8_t, now: u16) -> ins_status_t;
}
extern "C" {
    #[doc = "1 while a block is on its way."]
    pub fn ins_hs_board_busy(self_: *const ins_hs_board_t) -> uint_least8_t;
}
extern "C" {
    #[doc = "Next octet to put on the line, or -1 for none. Call whenever the transmitter is free."]
    pub fn ins_hs_board_tx(self_: *mut ins_hs_board_t, now: u16) -> i16;
}
extern "C" {
    #[doc = "An octet came from the host."]
    pub fn ins_hs_board_rx(self_: *mut ins_hs_board_t, octet: ins_octet_t, now: u16);
}
extern "C" {
    #[doc = "Time passes: call at least every reply_timeout / 2 or so; expires waits."]
    pub fn ins_hs_board_tick(self_: *mut ins_hs_board_t, now: u16);
}
pub const INS_HS_NOTHING: _bindgen_ty_11 = 0;
#[doc = "a new block is in self->block (sequence nibbles removed), self->seq and self->gap are set"]
pub const INS_HS_BLOCK: _bindgen_ty_11 = 1;
#[doc = "a block already delivered came again (cfg.seq only); it was acknowledged"]
pub const INS_HS_DUPLICATE: _bindgen_ty_11 = 2;
#[doc = "the sum did not agree; FF was answered, or the tries are used up"]
pub const INS_HS_CORRUPT: _bindgen_ty_11 = 3;
#[doc = "What an octet led to, on the host."]
pub type _bindgen_ty_11 = ::core::ffi::c_uint;
#[doc = "Host side (B). Start with ins_hs_host_init(). Members are private, block, seq, gap and the counters readable."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_hs_host_t {
    pub cfg: ins_hs_config_t,
    pub state: uint_least8_t,
    pub tries: uint_least8_t,
    pub count: uint_least8_t,
    pub sum: uint_least8_t,
    pub have_seq: uint_least8_t,
    #[doc = "sequence number of the last block delivered (0 with cfg.seq = 0)"]
    pub seq: uint_least8_t,
    #[doc = "blocks missing between the last two delivered, modulo 256 (0 with cfg.seq = 0)"]
    pub gap: uint_least8_t,
    pub since: u16,
    pub block: [ins_octet_t; 32usize],
    #[doc = "new blocks delivered"]
    pub accepted: u32,
    #[doc = "resent blocks recognised"]
    pub duplicates: u32,
    #[doc = "sums that did not agree"]
    pub corrupt: u32,
    #[doc = "blocks that stopped half-way"]
    pub timeouts: u32,
    #[doc = "octets that fit nowhere"]
    pub stray: u32,
}
extern "C" {
    #[doc = "In idle, counters 0. \\return as ins_hs_board_init()."]
    pub fn ins_hs_host_init(self_: *mut ins_hs_host_t, cfg: *const ins_hs_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "An octet came from the board. \\param[out] reply octet to send back (BB, 00, FF), or -1. \\return one of INS_HS_*."]
    pub fn ins_hs_host_rx(self_: *mut ins_hs_host_t, octet: ins_octet_t, now: u16, reply: *mut i16) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "Time passes without an octet: call it whenever the line has been silent for more than octet_timeout, else a block that stopped"]
    #[doc = "half-way is found only when the next one fails its sum. Never call it between octets that are already waiting to be read."]
    pub fn ins_hs_host_tick(self_: *mut ins_hs_host_t, now: u16);
}
extern "C" {
    #[doc = "The paper's block of three 12-bit codes, XH XL YH YL ZH ZL. A code's bits 15..12 are not sent (ins_hs_board_offer puts the"]
    #[doc = "sequence number there)."]
    #[doc = "\\param[in] codes  [3] \\param[out] block  [6]"]
    pub fn ins_hs_block_put(codes: *const u16, block: *mut ins_octet_t);
}
extern "C" {
    #[doc = "\\param[in] block  [6] \\param[out] codes  [3] 0..4095"]
    pub fn ins_hs_block_codes(block: *const ins_octet_t, codes: *mut u16);
}
#[doc = "Start with ins_hist2_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_hist2_t {
    #[doc = "scalar first; v_n = q v_b q*"]
    pub q_nb: [ins_real; 4usize],
    #[doc = "previous increments, newest first [rad]"]
    pub prev: [[ins_real; 3usize]; 2usize],
    #[doc = "previous increments held"]
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, or a norm that is not within 1e-3 of 1 (it is normalised), and then self is unchanged."]
    pub fn ins_hist2_init(self_: *mut ins_hist2_t, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Turn by one increment."]
    #[doc = "\\return INS_OK; INS_S_START for the first two; INS_E_RANGE for NaN or one that turns by more than 0.5, its coning term"]
    #[doc = "included, and then self is unchanged."]
    pub fn ins_hist2_step(self_: *mut ins_hist2_t, dtheta_b: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "One more octet."]
    pub fn ins_link_crc(crc: u16, octet: ins_octet_t) -> u16;
}
#[doc = "Board side. Members are private but for hs's counters and those below."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_link_board_t {
    #[doc = "the paper's form; holds the block and the counters of both forms"]
    pub hs: ins_hs_board_t,
    pub state: uint_least8_t,
    pub seq: uint_least8_t,
    #[doc = "the host answered 44 to this board"]
    pub known: uint_least8_t,
    #[doc = "blocks to go before the next 55 to a host that was silent"]
    pub paper_left: uint_least8_t,
    pub crc: u16,
    #[doc = "blocks acknowledged in the extended form"]
    pub extended: u16,
    #[doc = "times that 55 had no answer"]
    pub fallbacks: u16,
}
extern "C" {
    #[doc = "\\param[in] cfg  as for ins_hs_board_init(); cfg.seq says whether the paper's form carries a number too."]
    #[doc = "\\return also INS_E_RANGE for a block_len above INS_LINK_BLOCK_MAX."]
    pub fn ins_link_board_init(self_: *mut ins_link_board_t, cfg: *const ins_hs_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_hs_board_offer()."]
    pub fn ins_link_board_offer(self_: *mut ins_link_board_t, block: *const ins_octet_t, seq: uint_least8_t, now: u16) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_hs_board_busy()."]
    pub fn ins_link_board_busy(self_: *const ins_link_board_t) -> uint_least8_t;
}
extern "C" {
    #[doc = "As ins_hs_board_tx()."]
    pub fn ins_link_board_tx(self_: *mut ins_link_board_t, now: u16) -> i16;
}
extern "C" {
    #[doc = "As ins_hs_board_rx()."]
    pub fn ins_link_board_rx(self_: *mut ins_link_board_t, octet: ins_octet_t, now: u16);
}
extern "C" {
    #[doc = "As ins_hs_board_tick()."]
    pub fn ins_link_board_tick(self_: *mut ins_link_board_t, now: u16);
}
#[doc = "Host side. hs's block, seq, gap and counters are valid for both forms."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_link_host_t {
    pub hs: ins_hs_host_t,
    #[doc = "the frame under way, or else the last one, is extended"]
    pub extended: uint_least8_t,
    pub state: uint_least8_t,
    pub crc: u16,
}
extern "C" {
    #[doc = "As ins_hs_host_init(), and INS_E_RANGE for a block_len above INS_LINK_BLOCK_MAX."]
    pub fn ins_link_host_init(self_: *mut ins_link_host_t, cfg: *const ins_hs_config_t) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_hs_host_rx(), for either form."]
    pub fn ins_link_host_rx(self_: *mut ins_link_host_t, octet: ins_octet_t, now: u16, reply: *mut i16) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "As ins_hs_host_tick()."]
    pub fn ins_link_host_tick(self_: *mut ins_link_host_t, now: u16);
}
pub const INS_NAV_BLOCK_ALIGNED: _bindgen_ty_13 = 1;
pub const INS_NAV_BLOCK_INTEGER: _bindgen_ty_13 = 2;
pub const INS_NAV_BLOCK_FRACTION: _bindgen_ty_13 = 4;
pub const INS_NAV_BLOCK_POSITION: _bindgen_ty_13 = 8;
pub const INS_NAV_BLOCK_FILTER: _bindgen_ty_13 = 16;
pub const INS_NAV_BLOCK_ZONE_119: _bindgen_ty_13 = 32;
pub const INS_NAV_BLOCK_GATED: _bindgen_ty_13 = 64;
pub const INS_NAV_BLOCK_LINE_ERROR: _bindgen_ty_13 = 128;
pub const INS_NAV_BLOCK_GAP: _bindgen_ty_13 = 256;
pub const INS_NAV_BLOCK_WATCHDOG: _bindgen_ty_13 = 512;
pub const INS_NAV_BLOCK_CLIPPED: _bindgen_ty_13 = 1024;
pub const INS_NAV_BLOCK_STATUS_ALL: _bindgen_ty_13 = 2047;
pub type _bindgen_ty_13 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_nav_block_t {
    pub time_ms: u32,
    pub status: u16,
    pub sats: uint_least8_t,
    #[doc = "[0.1 s]"]
    pub fix_age: uint_least8_t,
    #[doc = "easting, northing"]
    pub en_cm: [i32; 2usize],
    #[doc = "velocity east, north [m/s]"]
    pub v_en: [ins_real; 2usize],
    #[doc = "scalar first, v_n = q v_b q*, n is NED"]
    pub q_nb: [ins_real; 4usize],
}
extern "C" {
    #[doc = "\\param[out] block  [INS_NAV_BLOCK_LEN]."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, a velocity above INS_NAV_BLOCK_V_MAX, a quaternion whose norm is not within 1e-3 of 1 (it is"]
    #[doc = "normalised), or status bits beyond INS_NAV_BLOCK_STATUS_ALL; block is then unchanged."]
    pub fn ins_nav_block_put(nav: *const ins_nav_block_t, block: *mut ins_octet_t) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] block  [INS_NAV_BLOCK_LEN], without a sequence number (as ins_hs_host_t has it)."]
    #[doc = "\\return INS_OK; INS_E_RANGE for another version, bits that are always 0, or components that are no quaternion's; nav is then unchanged."]
    pub fn ins_nav_block_get(block: *const ins_octet_t, nav: *mut ins_nav_block_t) -> ins_status_t;
}
pub const INS_NMEA_NOTHING: _bindgen_ty_14 = 0;
pub const INS_NMEA_GGA: _bindgen_ty_14 = 1;
pub const INS_NMEA_RMC: _bindgen_ty_14 = 2;
pub const INS_NMEA_VTG: _bindgen_ty_14 = 3;
#[doc = "What an octet led to."]
pub type _bindgen_ty_14 = ::core::ffi::c_uint;
pub const INS_NMEA_TIME: _bindgen_ty_15 = 1;
pub const INS_NMEA_POSITION: _bindgen_ty_15 = 2;
pub const INS_NMEA_SATS: _bindgen_ty_15 = 4;
pub const INS_NMEA_HDOP: _bindgen_ty_15 = 8;
pub const INS_NMEA_ALTITUDE: _bindgen_ty_15 = 16;
pub const INS_NMEA_GEOID: _bindgen_ty_15 = 32;
pub const INS_NMEA_SPEED: _bindgen_ty_15 = 64;
pub const INS_NMEA_COURSE: _bindgen_ty_15 = 128;
pub const INS_NMEA_DATE: _bindgen_ty_15 = 256;
#[doc = "Bits of ins_nmea_fix_t.has."]
pub type _bindgen_ty_15 = ::core::ffi::c_uint;
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_nmea_fix_t {
    #[doc = "which of the following were in the sentence"]
    pub has: u16,
    #[doc = "GGA: quality above 0; RMC: A; VTG: mode is not N"]
    pub valid: uint_least8_t,
    #[doc = "GGA: 0 none, 1 GPS, 2 differential, 4 fixed, 5 float ...; else 0"]
    pub quality: uint_least8_t,
    #[doc = "satellites in use"]
    pub sats: uint_least8_t,
    #[doc = "day, month, year of the century"]
    pub date: [uint_least8_t; 3usize],
    #[doc = "since midnight UTC"]
    pub time_ms: u32,
    #[doc = "[1e-7 deg], north and east positive"]
    pub lat_e7: i32,
    #[doc = "[1e-7 deg], north and east positive"]
    pub lon_e7: i32,
    #[doc = "above mean sea level"]
    pub altitude_mm: i32,
    #[doc = "mean sea level above the ellipsoid"]
    pub geoid_mm: i32,
    #[doc = "[1e-3]"]
    pub hdop_milli: i32,
    #[doc = "1 knot = 1852/3600 m/s"]
    pub speed_milliknot: i32,
    #[doc = "from true north, clockwise [1e-3 deg]"]
    pub course_mdeg: i32,
}
#[doc = "Owned by the caller. Members are private, fix and the counters readable."]
#[repr(C)]
#[derive(Debug, Copy, Clone)]
pub struct ins_nmea_t {
    pub state: uint_least8_t,
    pub count: uint_least8_t,
    #[doc = "of the body so far"]
    pub sum: uint_least8_t,
    #[doc = "first digit of the checksum; then whether it agrees"]
    pub sent: uint_least8_t,
    pub body: [ins_octet_t; 100usize],
    #[doc = "of the last sentence given out"]
    pub fix: ins_nmea_fix_t,
    #[doc = "sentences given out"]
    pub taken: u32,
    #[doc = "checksum did not agree, or was not two hexadecimal digits and the end of the line"]
    pub bad_checksum: u32,
    #[doc = "checksum right, but a field cannot be read"]
    pub malformed: u32,
    #[doc = "sentences that stopped, ran too long, or held what is no text"]
    pub cut: u32,
    #[doc = "right, but none of the three"]
    pub other: u32,
}
impl Default for ins_nmea_t {
    fn default() -> Self {
        let mut s = ::core::mem::MaybeUninit::<Self>::uninit();
        unsafe {
            ::core::ptr::write_bytes(s.as_mut_ptr(), 0, 1);
            s.assume_init()
        }
    }
}
extern "C" {
    #[doc = "Nothing seen yet, all counters 0."]
    pub fn ins_nmea_init(self_: *mut ins_nmea_t);
}
extern "C" {
    #[doc = "An octet came. \\return INS_NMEA_GGA, RMC or VTG: self->fix has it; else INS_NMEA_NOTHING."]
    pub fn ins_nmea_rx(self_: *mut ins_nmea_t, octet: ins_octet_t) -> ::core::ffi::c_int;
}
pub const INS_PVA_POSITION: _bindgen_ty_16 = 0;
pub const INS_PVA_VELOCITY: _bindgen_ty_16 = 1;
pub const INS_PVA_ACCELERATION: _bindgen_ty_16 = 2;
pub type _bindgen_ty_16 = ::core::ffi::c_uint;
#[doc = "Owned by the caller; readable."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_pva_t {
    #[doc = "position, velocity, acceleration"]
    pub x: [ins_real; 3usize],
    #[doc = "their covariance"]
    pub P: [ins_real; 9usize],
    #[doc = "gain of the last update"]
    pub K: [ins_real; 3usize],
}
extern "C" {
    #[doc = "x = 0; set it if it is known. \\param[in] var  [3] variances of x. \\return INS_E_RANGE if one is negative or not a number."]
    pub fn ins_pva_init(self_: *mut ins_pva_t, var: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] dt  time step [s], >= 0. \\param[in] q  [m^2/s^5], >= 0. \\return INS_E_RANGE and no change if either is not."]
    pub fn ins_pva_predict(self_: *mut ins_pva_t, dt: ins_real, q: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] what  INS_PVA_POSITION, VELOCITY or ACCELERATION: what was measured. Refusals as ins_kalman_update()."]
    pub fn ins_pva_update(self_: *mut ins_pva_t, what: ::core::ffi::c_int, z: *mut ins_innovation_t) -> ins_status_t;
}
#[doc = "Start with ins_q31_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_q31_t {
    #[doc = "Q30, scalar first; v_n = q v_b q*"]
    pub q_nb: [i32; 4usize],
    #[doc = "previous increments, newest first, Q31 [rad]"]
    pub prev: [[i32; 3usize]; 2usize],
    #[doc = "previous increments held"]
    pub count: uint_least8_t,
}
#[doc = "Start with ins_q31w_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_q31w_t {
    #[doc = "Q62"]
    pub q_nb: [i64; 4usize],
    pub prev: [[i32; 3usize]; 2usize],
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "\\param[in] q_nb  [4] Q30. \\return INS_OK; INS_E_RANGE for a norm that is not within 1e-3 of 1 (it is normalised)."]
    pub fn ins_q31_init(self_: *mut ins_q31_t, q_nb: *const i32) -> ins_status_t;
}
extern "C" {
    #[doc = "Turn by one increment. \\param[in] dtheta_b  [3] Q31 [rad], |dtheta| < 0.5."]
    #[doc = "\\return INS_OK; INS_S_START for the first two; INS_E_RANGE for one that turns by 0.5 or more, its coning"]
    #[doc = "term included, and then self is unchanged."]
    pub fn ins_q31_step(self_: *mut ins_q31_t, dtheta_b: *const i32) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_q31_init(); normalised to 62 places."]
    pub fn ins_q31w_init(self_: *mut ins_q31w_t, q_nb: *const i32) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_q31_step()."]
    pub fn ins_q31w_step(self_: *mut ins_q31w_t, dtheta_b: *const i32) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] q_nb  [4] Q30, rounded."]
    pub fn ins_q31w_get(self_: *const ins_q31w_t, q_nb: *mut i32);
}
extern "C" {
    #[doc = "\\param[out] out  [4] p q; may be p or q."]
    pub fn ins_quat_mul(p: *const ins_real, q: *const ins_real, out: *mut ins_real);
}
extern "C" {
    #[doc = "\\param[out] out  [4] q*, the inverse rotation of a unit quaternion; may be q."]
    pub fn ins_quat_conj(q: *const ins_real, out: *mut ins_real);
}
extern "C" {
    #[doc = "\\param[out] v_n  [3] q_nb v_b q_nb*; may be v_b."]
    pub fn ins_quat_rotate(q_nb: *const ins_real, v_b: *const ins_real, v_n: *mut ins_real);
}
extern "C" {
    #[doc = "Exact: divides by the square root. \\return INS_OK; INS_E_RANGE for NaN, infinity or a norm out of 1e-15 .. 1e15, q unchanged."]
    pub fn ins_quat_normalise(q: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "First order, without root or division: q (3/2 - |q|^2 / 2). Leaves a norm error of 3/8 eps^2, eps = 1 - |q|^2: for |eps| < 1e-3."]
    pub fn ins_quat_normalise_approx(q: *mut ins_real);
}
extern "C" {
    #[doc = "Rotation vector to quaternion, {cos(|phi|/2), phi sin(|phi|/2) / |phi|}, with no libm. The sign of q is that of the formula."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN or |phi| > INS_ROTVEC_MAX, q unchanged."]
    pub fn ins_quat_from_rotvec(phi: *const ins_real, q: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] euler  [3] roll, pitch, yaw [rad]. \\param[out] q_nb  [4]. Uses libm's sin and cos."]
    pub fn ins_quat_from_euler(euler: *const ins_real, q_nb: *mut ins_real);
}
extern "C" {
    #[doc = "Uses libm's atan2, for display and comparison. roll, yaw in [-pi, pi], pitch in [-pi/2, pi/2]. At a pole of pitch only"]
    #[doc = "yaw - roll (nose up) or yaw + roll (nose down) has a meaning: there the roll returned is 0, so no angle is noise."]
    pub fn ins_quat_to_euler(q_nb: *const ins_real, euler: *mut ins_real);
}
extern "C" {
    #[doc = "\\param[in] q_nb  [4] of unit length. \\param[out] C_nb  [9] row-major, v_n = C_nb v_b."]
    pub fn ins_quat_to_dcm(q_nb: *const ins_real, C_nb: *mut ins_real);
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE unless C_nb is a rotation (each element within 1e-3 of the one that q_nb gives), q_nb unchanged."]
    pub fn ins_quat_from_dcm(C_nb: *const ins_real, q_nb: *mut ins_real) -> ins_status_t;
}
#[doc = "Integrator. order 2 = trapezoid (2 samples), 3 = AM3, 4 = AM4, 5 = AM5. Start-up uses what samples there are."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_rates_t {
    pub order: uint_least8_t,
    #[doc = "samples held, 0..order"]
    pub count: uint_least8_t,
    #[doc = "sampling period [s]"]
    pub T: ins_real,
    #[doc = "newest first [rad/s]"]
    pub w: [[ins_real; 3usize]; 5usize],
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE unless order is 2..5 and period_s > 0."]
    pub fn ins_rates_init(self_: *mut ins_rates_t, order: uint_least8_t, period_s: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Next sample. \\param[out] dtheta_b [3] increment over the last period [rad]; zero for the very first sample."]
    #[doc = "\\return INS_OK; INS_S_START with fewer than `order` samples; INS_E_RANGE for NaN or infinity, self unchanged."]
    pub fn ins_rates_add(self_: *mut ins_rates_t, w_ib_b: *const ins_real, dtheta_b: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Next sample after `missing` lost ones (>= 1): trapezoid over (missing + 1) periods; the history restarts here."]
    pub fn ins_rates_bridge(self_: *mut ins_rates_t, missing: u32, w_ib_b: *const ins_real, dtheta_b: *mut ins_real) -> ins_status_t;
}
#[doc = "Channel-skew compensation: channel i is sampled delay_s[i] after the scan's instant; each is interpolated back to it with a"]
#[doc = "polynomial through its last samples (order 1 linear, 2 parabola, 3 cubic)."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_skew_t {
    pub order: uint_least8_t,
    pub count: uint_least8_t,
    #[doc = "delay / period, 0 <= . < 1"]
    pub fraction: [ins_real; 3usize],
    #[doc = "newest first"]
    pub x: [[ins_real; 3usize]; 4usize],
}
extern "C" {
    #[doc = "\\param[in] delay_s [3], 0 <= delay < period. \\return INS_OK or INS_E_RANGE."]
    pub fn ins_skew_init(self_: *mut ins_skew_t, order: uint_least8_t, delay_s: *const ins_real, period_s: ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] raw [3] as sampled; \\param[out] out [3] at the scan's instant; may be the same array."]
    pub fn ins_skew_add(self_: *mut ins_skew_t, raw: *const ins_real, out: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "After lost samples: keep only what comes next."]
    pub fn ins_skew_restart(self_: *mut ins_skew_t);
}
#[doc = "Start with ins_reuse_init(). Members are private."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_reuse_t {
    #[doc = "Q(k), Q(k+1), Q(k+2) in turn"]
    pub q_nb: [[ins_real; 4usize]; 3usize],
    #[doc = "the two increments before the next, oldest first [rad]"]
    pub theta: [[ins_real; 3usize]; 2usize],
    pub form: uint_least8_t,
    #[doc = "chain whose turn is next"]
    pub slot: uint_least8_t,
    #[doc = "increments held"]
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "\\param[in] form  INS_CONING_BLOCK3_FIT or _OPT. \\param[in] q_nb  [12] Q(0), Q(1), Q(2), each within 1e-3 of unit norm."]
    #[doc = "\\return INS_OK or INS_E_RANGE."]
    pub fn ins_reuse_init(self_: *mut ins_reuse_t, form: ::core::ffi::c_int, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] dtheta_b  [3] increment from t(k) to t(k+1), |component| <= pi. \\param[out] q_nb  [4] Q(k+1)."]
    #[doc = "\\return INS_OK; INS_S_START for the first two, where Q(1) and Q(2) of the start are returned; INS_E_RANGE, self unchanged."]
    pub fn ins_reuse_step(self_: *mut ins_reuse_t, dtheta_b: *const ins_real, q_nb: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\return 0, or the INS_SELFTEST_* of what failed, or-ed."]
    pub fn ins_selftest() -> ::core::ffi::c_uint;
}
#[doc = "Start with ins_thesis_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_thesis_t {
    #[doc = "scalar first; v_n = q v_b q*"]
    pub q_nb: [ins_real; 4usize],
    #[doc = "the increment before [rad]"]
    pub prev: [ins_real; 3usize],
    #[doc = "previous increments held, 0 or 1"]
    pub count: uint_least8_t,
}
extern "C" {
    #[doc = "P of (2-15)..(2-19): the quaternion of one interval, not normalised (|P|^2 = 1 - |theta|^4 / 192 + ...). Any input."]
    #[doc = "\\param[in] theta_b  [3] increment of the interval, \\param[in] prev_b  [3] of the one before [rad]. \\param[out] p  [4]"]
    pub fn ins_thesis_p(theta_b: *const ins_real, prev_b: *const ins_real, p: *mut ins_real);
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, or a quaternion whose norm is not within 1e-3 of 1 (it is normalised)."]
    pub fn ins_thesis_init(self_: *mut ins_thesis_t, q_nb: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "\\return INS_OK; INS_S_START for the first; INS_E_RANGE for NaN or |component| > 1 rad, and then self is unchanged."]
    pub fn ins_thesis_step(self_: *mut ins_thesis_t, dtheta_b: *const ins_real) -> ins_status_t;
}
#[doc = "Start with ins_thesis_rk4_init()."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_thesis_rk4_t {
    pub q_nb: [ins_real; 4usize],
    #[doc = "rate at the end of the last step [rad/s]"]
    pub w_ib_b: [ins_real; 3usize],
    #[doc = "k [1/s]"]
    pub feedback: ins_real,
    #[doc = "h"]
    pub step_s: ins_real,
}
extern "C" {
    #[doc = "q' = q w / 2 + k (1 - |q|^2) q. With k = 0 the norm is the caller's: ins_quat_normalise(r.q_nb) after each step."]
    #[doc = "\\param[in] feedback  k >= 0 [1/s]; a norm error decays as exp(-2 k t). k h <= 0.5 is a good choice."]
    #[doc = "\\param[in] step_s  h > 0; samples of the rate are needed every h / 2. \\param[in] w_ib_b  [3] rate at the start [rad/s]."]
    #[doc = "\\return INS_OK; INS_E_RANGE if 2 k h >= INS_THESIS_RK4_LIMIT, for NaN, or a norm not within 1e-3 of 1."]
    pub fn ins_thesis_rk4_init(
        self_: *mut ins_thesis_rk4_t,
        feedback: ins_real,
        step_s: ins_real,
        q_nb: *const ins_real,
        w_ib_b: *const ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "One step of h. \\return INS_OK; INS_E_RANGE for NaN or |component| h > pi, and then self is unchanged."]
    pub fn ins_thesis_rk4_step(self_: *mut ins_thesis_rk4_t, w_mid_b: *const ins_real, w_end_b: *const ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Passive ZXZ rotation of 2.8, R = Rz(gamma) Rx(beta) Rz(alpha), row-major. Its first row is what 4.5.4 plots with the integrals of"]
    #[doc = "P, Q, R as angles. That is no attitude of a body that rolls about x (a pure roll moves it): for comparison only. Uses libm."]
    #[doc = "\\param[in] angles  [3] alpha, beta, gamma [rad]"]
    pub fn ins_thesis_zxz(angles: *const ins_real, R: *mut ins_real);
}
#[doc = "One projection. Owned by the caller; read-only after init."]
#[repr(C)]
#[derive(Debug, Default, Copy, Clone)]
pub struct ins_tm_t {
    pub ellipsoid: ins_ellipsoid_t,
    #[doc = "central meridian [rad]"]
    pub lon0: ins_real,
    #[doc = "scale on it"]
    pub k0: ins_real,
    #[doc = "[m]"]
    pub false_e: ins_real,
    #[doc = "[m]"]
    pub false_n: ins_real,
    #[doc = "first eccentricity"]
    pub e: ins_real,
    #[doc = "k0 times the rectifying radius [m]"]
    pub unit: ins_real,
    pub alpha: [ins_real; 6usize],
    pub beta: [ins_real; 6usize],
    pub delta: [ins_real; 6usize],
}
extern "C" {
    #[doc = "\\return INS_OK; INS_E_RANGE unless 0 < f <= 1/150, |lon0| <= pi, k0 in [0.5, 2] and the false origin is finite."]
    pub fn ins_tm_init(
        self_: *mut ins_tm_t,
        ellipsoid: *const ins_ellipsoid_t,
        lon0: ins_real,
        k0: ins_real,
        false_easting: ins_real,
        false_northing: ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[in] zone  121 (Taiwan) or 119 (Penghu, Kinmen, Matsu). \\return INS_OK or INS_E_RANGE."]
    pub fn ins_tm_init_twd97(self_: *mut ins_tm_t, zone: ::core::ffi::c_int) -> ins_status_t;
}
extern "C" {
    #[doc = "The TWD97 zone of a longitude: 119 for 118 <= lon < 120 degrees, 121 for 120 <= lon < 123, otherwise 0."]
    pub fn ins_twd97_zone(lon: ins_real) -> ::core::ffi::c_int;
}
extern "C" {
    #[doc = "\\param[out] en  [2] easting, northing [m]. \\param[out] convergence  bearing of grid north from true north, clockwise [rad]; or NULL."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN, |latitude| > pi/2 or farther than INS_TM_DLON_MAX from the central meridian."]
    pub fn ins_tm_forward(
        self_: *const ins_tm_t,
        lat: ins_real,
        lon: ins_real,
        en: *mut ins_real,
        convergence: *mut ins_real,
    ) -> ins_status_t;
}
extern "C" {
    #[doc = "\\param[out] lat_lon  [2] [rad], longitude in [-pi, pi]."]
    #[doc = "\\return INS_OK; INS_E_RANGE for NaN or a point outside of what forward gives."]
    pub fn ins_tm_inverse(self_: *const ins_tm_t, en: *const ins_real, lat_lon: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "The series of a 2009 thesis on a GPS-enabled IMU, equations 5.6 and 5.7, corrected (docs/geodesy.md), for comparison with its results."]
    #[doc = "Forward within 1.3 degrees of the central meridian: 1e-7 m; inverse 1e-4 m. \\return as ins_tm_forward()."]
    pub fn ins_tm_thesis_forward(self_: *const ins_tm_t, lat: ins_real, lon: ins_real, en: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "As ins_tm_inverse(), by equations 5.8 and 5.9."]
    pub fn ins_tm_thesis_inverse(self_: *const ins_tm_t, en: *const ins_real, lat_lon: *mut ins_real) -> ins_status_t;
}
extern "C" {
    #[doc = "Version of the binary, as INS_VERSION."]
    pub fn ins_version() -> ::core::ffi::c_long;
}
extern "C" {
    #[doc = "\\return INS_OK, or INS_E_ABI: the program was compiled with the headers of another major or minor version, or for another"]
    #[doc = "ins_real. Patch releases go together."]
    pub fn ins_abi_check(version: ::core::ffi::c_long, real_size: ::core::ffi::c_uint) -> ins_status_t;
}
extern "C" {
    #[doc = "Text for a status code; \"unknown status\" for any other number."]
    pub fn ins_status_text(status: ins_status_t) -> *const ::core::ffi::c_char;
}
