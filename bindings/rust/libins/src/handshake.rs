//! The checksummed handshake of Zheng and Zhou (2010), 3.3, as two octet-driven state machines without transport or clock.
//!
//! The [`Board`] samples, the [`Host`] reads. `now` is a free-running 16-bit count in a unit of your choice, time-outs are in the same
//! unit and below 32768. What the sum cannot show: docs/handshake.md.
//! SPDX-License-Identifier: MIT
use crate::status::{done, init, same_length};
use crate::{sys, Error};

/// Longest block \[octets\].
pub const BLOCK_MAX: usize = sys::INS_HS_BLOCK_MAX as usize;

/// What both sides agree on; `reply_timeout` must be longer than `octet_timeout` and one exchange of octets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Config {
    /// 1 to [`BLOCK_MAX`] octets; at least 4 with `seq`.
    pub block_len: u8,
    /// Sequence number in the spare high nibbles of octets 0 and 2.
    pub seq: bool,
    /// Board: frames and requests sent again for one block. Host: FFs, less one, for one request.
    pub retries: u8,
    /// Board: longest wait for BB, 00 or FF.
    pub reply_timeout: u16,
    /// Host: longest silence inside a block.
    pub octet_timeout: u16,
}

impl Config {
    pub(crate) fn raw(&self) -> sys::ins_hs_config_t {
        sys::ins_hs_config_t {
            block_len: self.block_len,
            seq: self.seq.into(),
            retries: self.retries,
            reply_timeout: self.reply_timeout,
            octet_timeout: self.octet_timeout,
        }
    }
}

/// What the board counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoardCounters {
    /// Blocks acknowledged.
    pub sent: u16,
    /// Frames or requests sent again.
    pub resent: u16,
    /// Blocks dropped after the last retry.
    pub given_up: u16,
}

impl From<&sys::ins_hs_board_t> for BoardCounters {
    fn from(raw: &sys::ins_hs_board_t) -> Self {
        Self { sent: raw.sent, resent: raw.resent, given_up: raw.given_up }
    }
}

/// An octet to put on the line, of the C form where -1 is none.
pub(crate) fn octet(raw: i16) -> Option<u8> {
    u8::try_from(raw).ok()
}

/// The sampling board, A.
#[derive(Clone, Copy, Debug)]
pub struct Board(sys::ins_hs_board_t);

impl Board {
    /// Idle.
    pub fn new(config: &Config) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_hs_board_init(s, &config.raw()) }).map(Self)
    }

    /// Offer a block and its sequence number (ignored without [`Config::seq`]); [`Error::State`] while one is on its way.
    pub fn offer(&mut self, block: &[u8], seq: u8, now: u16) -> Result<(), Error> {
        same_length(block.len(), self.0.cfg.block_len.into())?;
        // SAFETY: a block of the agreed length.
        done(unsafe { sys::ins_hs_board_offer(&mut self.0, block.as_ptr(), seq, now) })
    }

    /// Whether a block is on its way.
    pub fn busy(&self) -> bool {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_hs_board_busy(&self.0) != 0 }
    }

    /// Next octet for the line: ask whenever the transmitter is free.
    pub fn tx(&mut self, now: u16) -> Option<u8> {
        // SAFETY: the state is initialised.
        octet(unsafe { sys::ins_hs_board_tx(&mut self.0, now) })
    }

    /// An octet came from the host.
    pub fn rx(&mut self, octet: u8, now: u16) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_hs_board_rx(&mut self.0, octet, now) }
    }

    /// Time passes: at least every `reply_timeout` / 2 or so.
    pub fn tick(&mut self, now: u16) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_hs_board_tick(&mut self.0, now) }
    }

    /// Counters.
    pub fn counters(&self) -> BoardCounters {
        (&self.0).into()
    }
}

/// What an octet led to, on the host.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Nothing yet.
    Nothing,
    /// A new block is in [`Host::block`].
    Block,
    /// A block already delivered came again and was acknowledged (with [`Config::seq`]).
    Duplicate,
    /// The sum did not agree.
    Corrupt,
}

impl Event {
    pub(crate) fn of(raw: i32) -> Self {
        match raw as u32 {
            sys::INS_HS_BLOCK => Event::Block,
            sys::INS_HS_DUPLICATE => Event::Duplicate,
            sys::INS_HS_CORRUPT => Event::Corrupt,
            _ => Event::Nothing,
        }
    }
}

/// What the host counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HostCounters {
    /// New blocks delivered.
    pub accepted: u32,
    /// Resent blocks recognised.
    pub duplicates: u32,
    /// Sums that did not agree.
    pub corrupt: u32,
    /// Blocks that stopped half-way.
    pub timeouts: u32,
    /// Octets that fit nowhere.
    pub stray: u32,
}

impl From<&sys::ins_hs_host_t> for HostCounters {
    fn from(raw: &sys::ins_hs_host_t) -> Self {
        Self { accepted: raw.accepted, duplicates: raw.duplicates, corrupt: raw.corrupt, timeouts: raw.timeouts, stray: raw.stray }
    }
}

/// The host, B.
#[derive(Clone, Copy, Debug)]
pub struct Host(sys::ins_hs_host_t);

impl Host {
    /// Idle.
    pub fn new(config: &Config) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_hs_host_init(s, &config.raw()) }).map(Self)
    }

    /// An octet came from the board; what it led to, and the octet to send back.
    pub fn rx(&mut self, from_board: u8, now: u16) -> (Event, Option<u8>) {
        let mut reply = -1;
        // SAFETY: both are valid.
        let event = unsafe { sys::ins_hs_host_rx(&mut self.0, from_board, now, &mut reply) };
        (Event::of(event), octet(reply))
    }

    /// The line has been silent for more than `octet_timeout`; never between octets that wait to be read.
    pub fn tick(&mut self, now: u16) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_hs_host_tick(&mut self.0, now) }
    }

    /// The last block.
    pub fn block(&self) -> &[u8] {
        &self.0.block[..usize::from(self.0.cfg.block_len)]
    }

    /// Its sequence number; 0 without [`Config::seq`].
    pub fn seq(&self) -> u8 {
        self.0.seq
    }

    /// Blocks missing between the last two, modulo 256; 0 without [`Config::seq`].
    pub fn gap(&self) -> u8 {
        self.0.gap
    }

    /// Counters.
    pub fn counters(&self) -> HostCounters {
        (&self.0).into()
    }
}

/// The paper's block of three 12-bit codes, XH XL YH YL ZH ZL.
pub fn block_put(codes: &[u16; 3]) -> [u8; 6] {
    let mut block = [0; 6];
    // SAFETY: 3 codes in, 6 octets out.
    unsafe { sys::ins_hs_block_put(codes.as_ptr(), block.as_mut_ptr()) }
    block
}

/// Three codes, 0 to 4095, of the paper's block.
pub fn block_codes(block: &[u8; 6]) -> [u16; 3] {
    let mut codes = [0; 3];
    // SAFETY: 6 octets in, 3 codes out.
    unsafe { sys::ins_hs_block_codes(block.as_ptr(), codes.as_mut_ptr()) }
    codes
}
