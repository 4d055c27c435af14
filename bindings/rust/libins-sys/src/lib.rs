//! The C core of libins as C declares it: see libins/core/include/ins/*.h for what each function does, in which frame and unit.
//!
//! `bindings.rs` is made by bindgen (bindings/rust/generate); `libins` is the safe form of it. The feature `double` (default) or
//! `float` sets [`ins_real`] and with it the whole library.
//! SPDX-License-Identifier: MIT
#![no_std]
#![allow(clippy::excessive_precision, non_camel_case_types, non_snake_case, non_upper_case_globals, rustdoc::broken_intra_doc_links)]

#[cfg(all(feature = "double", feature = "float"))]
compile_error!("libins-sys: choose one of the features `double` and `float`; float needs default-features = false");

#[cfg(not(feature = "float"))]
pub type ins_real = f64;
#[cfg(feature = "float")]
pub type ins_real = f32;

type uint_least8_t = u8;
type uint_least32_t = u32;

include!("bindings.rs");

// Macros of type ins_real, which bindgen leaves out; tests/bindings/test_rust.py compares each with its header.
pub const INS_EARTH_RATE: ins_real = 7.292115e-5;
pub const INS_GEODESY_RADIUS_MIN: ins_real = 0.5;
pub const INS_GIMU_G: ins_real = 9.8;
pub const INS_GIMU_G_NOMINAL: ins_real = 3300.0 / 4095.0 / 800.0;
pub const INS_GIMU_KP: ins_real = 0.2087;
pub const INS_GIMU_KQ: ins_real = 0.2099;
pub const INS_GIMU_KR: ins_real = 0.1993;
pub const INS_GIMU_K_NOMINAL: ins_real = 3300.0 / 4095.0 / 4.0;
pub const INS_GIMU_NULL: ins_real = 2047.0;
pub const INS_GPS_AXIS_TAU_RATIO_MIN: ins_real = 0.1;
pub const INS_GPS_INS_DELAY_MAX: ins_real = 0.5;
pub const INS_GPS_INS_GATE3_999: ins_real = 16.266236;
pub const INS_KALMAN_GATE2_99: ins_real = 9.2103404;
pub const INS_KALMAN_GATE_99: ins_real = 6.6348966;
pub const INS_KALMAN_GATE_999: ins_real = 10.8275662;
pub const INS_KF15_SCALE_MAX: ins_real = 0.1;
pub const INS_MARKOV_DEG_PER_HOUR: ins_real = 4.848_136_811_095_36e-6;
pub const INS_MARKOV_GIMBAL_SIGMA: ins_real = 0.01 * INS_MARKOV_DEG_PER_HOUR;
pub const INS_MARKOV_GIMBAL_TAU_S: ins_real = 7200.0;
pub const INS_MARKOV_STRAPDOWN_SIGMA: ins_real = INS_MARKOV_DEG_PER_HOUR;
pub const INS_MARKOV_STRAPDOWN_TAU_S: ins_real = 300.0;
pub const INS_NAV_BLOCK_V_MAX: ins_real = 8388.0;
pub const INS_STRAPDOWN_COS_MIN: ins_real = 1e-3;
pub const INS_STRAPDOWN_PERIOD_MAX: ins_real = 1.0;
pub const INS_STRAPDOWN_SPEED_MAX: ins_real = 1e4;
pub const INS_THESIS_RK4_LIMIT: ins_real = 2.785;
pub const INS_TM_DLON_MAX: ins_real = 0.174_532_925_199_432_96;
pub const INS_Q31_ONE: i32 = 0x4000_0000;
