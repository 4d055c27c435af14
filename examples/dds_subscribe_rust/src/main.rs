//! Prints navigation states that arrive over DDS, on RustDDS: of libins it has the layout of a type.   dds-subscribe [DOMAIN [COUNT]]
// SPDX-License-Identifier: MIT
use std::time::Duration;

use mio::{Events, Interest, Poll, Token};
use rustdds::policy::{History, Reliability};
use rustdds::with_key::Sample;
use rustdds::{DomainParticipant, Keyed, QosPolicyBuilder, TopicKind};
use serde::{Deserialize, Serialize};

const POSITION: u32 = 0x20; // bits of valid: ins_nav/navigation.h
const COVARIANCE: u32 = 0x80;

// As in share/libins/idl/libins.idl, which has the units. RustDDS compares names, not layouts: another layout gives garbage.
#[derive(Serialize, Deserialize)]
#[allow(dead_code)]
struct NavCounts {
    accepted: u64,
    lost: u64,
    invalid: u64,
    duplicates: u64,
    corrupt: u64,
    timeouts: u64,
    stray: u64,
}

#[derive(Serialize, Deserialize)]
#[allow(dead_code)]
struct NavState {
    source: String,
    published_ns: i64,
    time_ns: i64,
    time_base: u32,
    valid: u32,
    index: u64,
    t_s: f64,
    q_nb: [f64; 4],
    euler_rad: [f64; 3],
    w_ib_b: [f64; 3],
    f_b: [f64; 3],
    v_n: [f64; 3],
    llh: [f64; 3],
    p: [[f64; 9]; 5], // 45 in a row; serde's arrays end at 32
    dtheta_b: [f64; 3],
    seq: u32,
    bridged: u32,
    status: u32,
    used: u64,
    missed: u64,
    counts: NavCounts,
}

impl Keyed for NavState {
    type K = String;

    fn key(&self) -> String {
        self.source.clone()
    }
}

/// As far as the source knows it: latitude, longitude, and the larger of their standard deviations.
fn place(state: &NavState) -> String {
    let mut text = String::new();
    if state.valid & POSITION != 0 {
        let (latitude, longitude) = (state.llh[0].to_degrees(), state.llh[1].to_degrees());
        text += &format!(", {latitude:.7} {longitude:.7} deg");
        if state.valid & COVARIANCE != 0 {
            let p = state.p.as_flattened();
            text += &format!(" +- {:.2} m", p[39].max(p[42]).sqrt());
        }
    }
    text
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let domain: u16 = arguments.next().map_or(Ok(0), |text| text.parse())?;
    let mut left: u64 = arguments.next().map_or(Ok(u64::MAX), |text| text.parse())?;

    let qos = QosPolicyBuilder::new()
        .reliability(Reliability::Reliable { max_blocking_time: rustdds::Duration::ZERO })
        .history(History::KeepLast { depth: 100 })
        .build();
    let participant = DomainParticipant::new(domain)?; // every interface, the loopback too
    let topic = participant.create_topic("libins/nav_state".to_string(), "libins::NavState".to_string(), &qos, TopicKind::WithKey)?;
    let subscriber = participant.create_subscriber(&qos)?;
    let mut reader = subscriber.create_datareader_cdr::<NavState>(&topic, Some(qos))?;

    let mut poll = Poll::new()?;
    let mut events = Events::with_capacity(1);
    poll.registry().register(&mut reader, Token(0), Interest::READABLE)?;
    while left > 0 {
        poll.poll(&mut events, Some(Duration::from_secs(10)))?;
        if events.is_empty() {
            return Err("nothing came for 10 s".into());
        }
        while let Some(sample) = reader.take_next_sample()? {
            match sample.into_value() {
                Sample::Value(state) if left > 0 => {
                    let [roll, pitch, yaw] = state.euler_rad;
                    let (source, index, place) = (&state.source, state.index, place(&state));
                    println!("{source} {index}: roll {roll:.6} pitch {pitch:.6} yaw {yaw:.6} rad{place}");
                    left -= 1;
                }
                Sample::Value(_) => {}
                Sample::Dispose(source) => println!("{source}: its publisher has gone"),
            }
        }
    }
    Ok(())
}
