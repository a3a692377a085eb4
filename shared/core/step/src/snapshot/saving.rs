//! Writing a snapshot: once through the balls in id order, the checksum taken on the way.

use std::mem::MaybeUninit;

use wide::u64x2;

use super::{MAGIC, VERSION};
use crate::checksum::{Checksum, ROW};
use crate::codec::{SUM_BYTES, Writer};
use crate::{Balls, Counters, HeldKind, NO_BALL, State, Vec2};

/// Where a byte is written: memory that holds one, or nothing yet.
pub trait Slot: Sized {
    /// One that holds `byte`.
    fn holding(byte: u8) -> Self;
}

impl Slot for u8 {
    #[inline(always)]
    fn holding(byte: u8) -> u8 {
        byte
    }
}

impl Slot for MaybeUninit<u8> {
    #[inline(always)]
    fn holding(byte: u8) -> MaybeUninit<u8> {
        MaybeUninit::new(byte)
    }
}

/// A snapshot about to be written: how long it is shows before, so that it is written to where it belongs.
pub struct Saving<'a> {
    balls: &'a Balls,
    head: Vec<u8>,
}

impl Saving<'_> {
    pub(crate) fn new(state: &State) -> Saving<'_> {
        Saving {
            balls: &state.balls,
            head: head(state),
        }
    }

    /// Its number of bytes.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "it never is")]
    pub fn len(&self) -> usize {
        let shapes = if self.balls.uniform().is_some() { 0 } else { 16 };
        self.head.len() + self.balls.len() * (shapes + 40) + SUM_BYTES
    }

    /// Writes it to `slots`, of exactly that length: into each of them.
    ///
    /// # Panics
    /// If the length is another.
    pub fn write_to<S: Slot>(&self, slots: &mut [S]) {
        assert_eq!(slots.len(), self.len(), "a snapshot is as long as it says");
        let balls = self.balls;
        let mut sealing = Sealing {
            bytes: slots.len() - SUM_BYTES,
            slots,
            sum: Checksum::new(),
        };
        let (head, _) = self.head.as_chunks::<8>();
        let (head, _) = head.as_chunks::<2>();
        sealing.rows(head.iter().map(|words| words.map(u64::from_le_bytes)));
        let (radius, mass) = (&balls.radius[..], &balls.mass[..]);
        if balls.uniform().is_none() {
            sealing.each(balls, |index| [radius[index], mass[index]].map(f64::to_bits));
        }
        for vectors in [&balls.position[..], &balls.velocity[..]] {
            sealing.each(balls, |index| {
                let Vec2 { x, y } = vectors[index];
                [x, y].map(f64::to_bits)
            });
        }
        match balls.indices_by_id() {
            Some(indices) => sealing.ids_at(&balls.id, indices),
            None => sealing.ids(&balls.id),
        }
    }
}

/// What is still to be written, and the checksum of what was.
struct Sealing<'a, S> {
    bytes: usize,
    slots: &'a mut [S],
    sum: Checksum,
}

impl<S: Slot> Sealing<'_, S> {
    /// The next rows.
    #[inline(always)]
    fn rows(&mut self, rows: impl ExactSizeIterator<Item = [u64; 2]>) {
        let (slots, rest) = std::mem::take(&mut self.slots).split_at_mut(rows.len() * ROW);
        // A copy, which stays in registers.
        let mut sum = self.sum;
        let (slots, _) = slots.as_chunks_mut::<8>();
        let (slots, _) = slots.as_chunks_mut::<2>();
        for (slots, row) in slots.iter_mut().zip(rows) {
            *slots = row.map(|word| word.to_le_bytes().map(S::holding));
            sum.row(row);
        }
        self.sum = sum;
        self.slots = rest;
    }

    /// A row of each ball, in id order.
    #[inline(always)]
    fn each(&mut self, balls: &Balls, row: impl Fn(usize) -> [u64; 2]) {
        match balls.indices_by_id() {
            Some(indices) => self.rows(indices.iter().map(|&index| row(index as usize))),
            None => self.rows((0..balls.len()).map(row)),
        }
    }

    /// Ids, in this order, and the end.
    fn ids(&mut self, ids: &[u64]) {
        let (rows, rest) = ids.as_chunks::<2>();
        self.rows(rows.iter().copied());
        self.end(rest);
    }

    /// Ids that ascend in the order of `indices`, and the end. Those from one to another are read only where some between
    /// them are missing.
    fn ids_at(&mut self, ids: &[u64], indices: &[u32]) {
        const STRETCH: usize = 256;
        let id = |index: u32| ids[index as usize];
        let (stretches, rest) = indices.as_chunks::<STRETCH>();
        for stretch in stretches {
            let (first, last) = (id(stretch[0]), id(stretch[STRETCH - 1]));
            if last - first == STRETCH as u64 - 1 {
                let mut next = u64x2::new([first, first + 1]);
                self.rows((0..STRETCH / 2).map(|_| {
                    let row = next.to_array();
                    next += u64x2::splat(2);
                    row
                }));
            } else {
                let (pairs, _) = stretch.as_chunks::<2>();
                self.rows(pairs.iter().map(|pair| pair.map(id)));
            }
        }
        let rest: Vec<u64> = rest.iter().map(|&index| id(index)).collect();
        self.ids(&rest);
    }

    /// At most one more word, and the checksum.
    fn end(&mut self, word: &[u64]) {
        let word: Vec<u8> = word.iter().flat_map(|word| word.to_le_bytes()).collect();
        let sum = self.sum.end(&word, self.bytes).to_le_bytes();
        assert_eq!(self.slots.len(), word.len() + sum.len(), "each slot is written");
        for (slot, byte) in self.slots.iter_mut().zip(word.into_iter().chain(sum)) {
            *slot = S::holding(byte);
        }
    }
}

/// All but the balls, and what they share.
fn head(state: &State) -> Vec<u8> {
    let mut writer = Writer::new(MAGIC, VERSION);
    writer.u32(crate::STEP_VERSION);
    writer.u64(state.tick);
    writer.u64(state.variable_ticks);
    writer.f64(state.variable_time);
    writer.u64(state.next_id);
    let Counters {
        collisions,
        wall_hits,
        inputs_applied,
        inputs_ignored,
    } = state.counters;
    for counter in [collisions, wall_hits, inputs_applied, inputs_ignored] {
        writer.u64(counter);
    }
    writer.count(state.players.len());
    for player in &state.players {
        writer.u32(player.client);
        writer.u64(player.ball.unwrap_or(NO_BALL));
    }
    writer.count(state.held.len());
    for held in &state.held {
        writer.u32(held.client);
        writer.u8(match held.kind {
            HeldKind::Thrust => 0,
            HeldKind::Attract => 1,
        });
        writer.vec2(held.vector);
        writer.f64(held.strength);
    }
    writer.count(state.balls.len());
    match state.balls.uniform() {
        Some(shape) => {
            writer.u8(1);
            writer.f64(shape.radius);
            writer.f64(shape.mass);
        }
        None => writer.u8(0),
    }
    writer.unsealed()
}
