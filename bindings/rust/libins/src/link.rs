//! Extended frame of the handshake: CRC-16 and an 8-bit sequence number, with fall-back to the paper's block. docs/link.md.
//!
//! Either side may be the old one ([`crate::handshake`]).
//! SPDX-License-Identifier: MIT
use crate::handshake::{octet, BoardCounters, Config, Event, HostCounters};
use crate::status::{done, init, same_length};
use crate::{sys, Error};

/// Longest block \[octets\].
pub const BLOCK_MAX: usize = sys::INS_LINK_BLOCK_MAX as usize;
/// Start of [`crc`].
pub const CRC_START: u16 = sys::INS_LINK_CRC_START as u16;

/// CRC-16 of the frame, polynomial 0x90D9, over one more octet.
pub fn crc(crc: u16, octet: u8) -> u16 {
    // SAFETY: no memory is passed.
    unsafe { sys::ins_link_crc(crc, octet) }
}

/// The sampling board.
#[derive(Clone, Copy, Debug)]
pub struct Board(sys::ins_link_board_t);

impl Board {
    /// As [`crate::handshake::Board::new`], for blocks of up to [`BLOCK_MAX`] octets.
    pub fn new(config: &Config) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_link_board_init(s, &config.raw()) }).map(Self)
    }

    /// Offer a block with its sequence number; [`Error::State`] while one is on its way.
    pub fn offer(&mut self, block: &[u8], seq: u8, now: u16) -> Result<(), Error> {
        same_length(block.len(), self.0.hs.cfg.block_len.into())?;
        // SAFETY: a block of the agreed length.
        done(unsafe { sys::ins_link_board_offer(&mut self.0, block.as_ptr(), seq, now) })
    }

    /// Whether a block is on its way.
    pub fn busy(&self) -> bool {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_link_board_busy(&self.0) != 0 }
    }

    /// Next octet for the line.
    pub fn tx(&mut self, now: u16) -> Option<u8> {
        // SAFETY: the state is initialised.
        octet(unsafe { sys::ins_link_board_tx(&mut self.0, now) })
    }

    /// An octet came from the host.
    pub fn rx(&mut self, octet: u8, now: u16) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_link_board_rx(&mut self.0, octet, now) }
    }

    /// Time passes.
    pub fn tick(&mut self, now: u16) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_link_board_tick(&mut self.0, now) }
    }

    /// Counters of both forms.
    pub fn counters(&self) -> BoardCounters {
        (&self.0.hs).into()
    }

    /// Blocks acknowledged in the extended form.
    pub fn extended(&self) -> u16 {
        self.0.extended
    }

    /// Times that the extended request had no answer.
    pub fn fallbacks(&self) -> u16 {
        self.0.fallbacks
    }
}

/// The host.
#[derive(Clone, Copy, Debug)]
pub struct Host(sys::ins_link_host_t);

impl Host {
    /// As [`crate::handshake::Host::new`].
    pub fn new(config: &Config) -> Result<Self, Error> {
        // SAFETY: both are valid.
        init(|s| unsafe { sys::ins_link_host_init(s, &config.raw()) }).map(Self)
    }

    /// An octet came from the board; what it led to, and the octet to send back.
    pub fn rx(&mut self, from_board: u8, now: u16) -> (Event, Option<u8>) {
        let mut reply = -1;
        // SAFETY: both are valid.
        let event = unsafe { sys::ins_link_host_rx(&mut self.0, from_board, now, &mut reply) };
        (Event::of(event), octet(reply))
    }

    /// The line has been silent.
    pub fn tick(&mut self, now: u16) {
        // SAFETY: the state is initialised.
        unsafe { sys::ins_link_host_tick(&mut self.0, now) }
    }

    /// The last block.
    pub fn block(&self) -> &[u8] {
        &self.0.hs.block[..usize::from(self.0.hs.cfg.block_len)]
    }

    /// Its sequence number.
    pub fn seq(&self) -> u8 {
        self.0.hs.seq
    }

    /// Blocks missing between the last two, modulo 256.
    pub fn gap(&self) -> u8 {
        self.0.hs.gap
    }

    /// Whether the last frame was extended.
    pub fn is_extended(&self) -> bool {
        self.0.extended != 0
    }

    /// Counters of both forms.
    pub fn counters(&self) -> HostCounters {
        (&self.0.hs).into()
    }
}
