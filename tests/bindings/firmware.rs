//! A firmware in Rust without std and without an allocator: what its main would call. Linked into a C program by test_rust.py.
//! SPDX-License-Identifier: MIT
#![no_std]

use libins::{attitude::Attitude, coning::Form, gimu, handshake, kalman, nmea, q31, rates::Rates, sculling::Increment, selftest, strapdown};
use libins::{Error, Real};

#[panic_handler]
fn stop(_: &core::panic::PanicInfo) -> ! {
    loop {}
}

fn navigate() -> Result<Real, Error> {
    let level = [1.0, 0.0, 0.0, 0.0];
    let mut rates = Rates::new(4, 0.02)?;
    let mut attitude = Attitude::new(Form::Hist2Opt, &level)?;
    for _ in 0..500 {
        let (dtheta_b, _) = rates.add(&[0.1, 0.0, 0.2])?;
        attitude.step(&dtheta_b)?;
    }
    let start = strapdown::Position { anchor: [0.4, 2.1, 100.0], offset: [0.0; 3] };
    strapdown::Strapdown::new(Form::Hist2Opt, 0.02, attitude.q_nb(), &[0.0; 3], &start)?.step(&Increment::default())?;
    let mut filter = kalman::Kalman::new([0.0], [[1.0]]);
    filter.update(&[1.0], &kalman::Innovation { v: 1.0, r: 1.0, gate: 0.0 })?;
    q31::Q31::new(&[q31::ONE, 0, 0, 0])?.step(&[1 << 20, 0, 0])?;
    let config = handshake::Config { block_len: 6, seq: true, retries: 2, reply_timeout: 100, octet_timeout: 20 };
    handshake::Board::new(&config)?.offer(&handshake::block_put(&[1, 2, 3]), 0, 0)?;
    let parsed = gimu::Parser::new(true).rx(0xAA).is_some() || nmea::Parser::default().rx(b'$').is_some();
    Ok(if parsed { 0.0 } else { attitude.q_nb()[0] })
}

/// 0, or what went wrong.
#[no_mangle]
pub extern "C" fn fly() -> i32 {
    match (selftest::selftest(), navigate()) {
        (Err(_), _) => 1,
        (_, Err(_)) => 2,
        (_, Ok(w)) if !(0.439..0.440).contains(&w) => 3, // cos of half of 499 periods of 20 ms at 0.2236 rad/s
        _ => 0,
    }
}
