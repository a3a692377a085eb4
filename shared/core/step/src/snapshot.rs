//! Snapshots: a whole state as bytes, versioned and checksummed. What is restored continues bit for bit.

use crate::codec::{Reader, SUM_BYTES, Writer};
use crate::{Balls, Counters, Error, Held, HeldKind, NO_BALL, Player, State, Vec2, hash};

const MAGIC: &[u8; 4] = b"KGSN";
/// 2: the checksum is computed in lanes, which made snapshots of 10,000 balls four times as fast.
const VERSION: u32 = 2;
const WHAT: &str = "snapshot";

/// A snapshot about to be written: how long it is shows before, so that it is written to where it belongs.
pub struct Saving<'a> {
    balls: &'a Balls,
    head: Vec<u8>,
    tail: Vec<u8>,
}

impl Saving<'_> {
    pub(crate) fn new(state: &State) -> Saving<'_> {
        Saving {
            balls: &state.balls,
            head: head(state),
            tail: tail(state),
        }
    }

    /// Its number of bytes.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "it never is")]
    pub fn len(&self) -> usize {
        let shapes = if self.balls.uniform().is_some() { 0 } else { 16 };
        self.head.len() + self.balls.len() * (shapes + 40) + self.tail.len() + SUM_BYTES
    }

    /// Writes it to `bytes`, of exactly that length.
    ///
    /// # Panics
    /// If the length is another.
    pub fn write_to(&self, bytes: &mut [u8]) {
        assert_eq!(bytes.len(), self.len(), "a snapshot is as long as it says");
        let balls = self.balls;
        let (body, sum) = bytes.split_at_mut(bytes.len() - SUM_BYTES);
        let (head, rest) = body.split_at_mut(self.head.len());
        head.copy_from_slice(&self.head);
        let rest = if balls.uniform().is_some() {
            rest
        } else {
            each(balls, rest, |index| {
                [balls.radius[index], balls.mass[index]].map(f64::to_bits)
            })
        };
        let rest = each(balls, rest, |index| [balls.id[index]]);
        let rest = each(balls, rest, |index| bits(balls.position[index]));
        let rest = each(balls, rest, |index| bits(balls.velocity[index]));
        rest.copy_from_slice(&self.tail);
        sum.copy_from_slice(&hash::checksum(body).to_le_bytes());
    }
}

fn bits(vector: Vec2) -> [u64; 2] {
    [vector.x.to_bits(), vector.y.to_bits()]
}

/// Writes so many words of each ball, in id order; returns what is left.
fn each<'a, const WORDS: usize>(
    balls: &Balls,
    bytes: &'a mut [u8],
    words: impl Fn(usize) -> [u64; WORDS],
) -> &'a mut [u8] {
    let (bytes, rest) = bytes.split_at_mut(balls.len() * WORDS * 8);
    let (slots, _) = bytes.as_chunks_mut::<8>();
    for (slots, index) in slots.chunks_exact_mut(WORDS).zip(balls.by_id()) {
        for (slot, word) in slots.iter_mut().zip(words(index)) {
            *slot = word.to_le_bytes();
        }
    }
    rest
}

/// All before the balls, and what they share.
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

/// All behind the balls.
fn tail(state: &State) -> Vec<u8> {
    let mut writer = Writer::default();
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
    writer.unsealed()
}

/// Reads a state and checks all that a step relies on.
pub(crate) fn read(bytes: &[u8]) -> Result<State, Error> {
    let mut reader = Reader::open(bytes, MAGIC, VERSION, WHAT)?;
    let step = reader.u32()?;
    if step != crate::STEP_VERSION {
        return Err(Error::Snapshot(format!(
            "snapshot was made by step version {step}, this build steps version {}: its future would differ",
            crate::STEP_VERSION
        )));
    }
    let mut state = State {
        tick: reader.u64()?,
        variable_ticks: reader.u64()?,
        variable_time: reader.f64()?,
        next_id: reader.u64()?,
        ..State::default()
    };
    if state.variable_ticks > state.tick || !state.variable_time.is_finite() {
        return Err(Error::Snapshot(format!(
            "snapshot counts {} of {} ticks, {} s, as variable",
            state.variable_ticks, state.tick, state.variable_time
        )));
    }
    state.counters = Counters {
        collisions: reader.u64()?,
        wall_hits: reader.u64()?,
        inputs_applied: reader.u64()?,
        inputs_ignored: reader.u64()?,
    };
    read_balls(&mut reader, &mut state)?;
    read_players(&mut reader, &mut state)?;
    read_held(&mut reader, &mut state)?;
    reader.end()?;
    Ok(state)
}

fn read_balls(reader: &mut Reader<'_>, state: &mut State) -> Result<(), Error> {
    let count = reader.count(40)?;
    let (radius, mass) = if reader.u8()? == 0 {
        let shapes = reader.columns::<2>(count)?;
        shapes
            .map(|[radius, mass]| (f64::from_bits(radius), f64::from_bits(mass)))
            .unzip()
    } else {
        (vec![reader.f64()?; count], vec![reader.f64()?; count])
    };
    let id: Vec<u64> = reader.columns::<1>(count)?.map(|[id]| id).collect();
    if !id.is_sorted_by(|a, b| a < b) || id.last().is_some_and(|&last| last >= state.next_id) {
        return Err(Error::Snapshot(format!(
            "snapshot's ball ids must ascend and stay below the next id, {}",
            state.next_id
        )));
    }
    let vector = |[x, y]: [u64; 2]| Vec2::new(f64::from_bits(x), f64::from_bits(y));
    let position = reader.columns(count)?.map(vector).collect();
    let velocity = reader.columns(count)?.map(vector).collect();
    state.balls = Balls::from_columns(position, velocity, radius, mass, id)
        .map_err(|error| Error::Snapshot(format!("the snapshot's {error}")))?;
    Ok(())
}

fn read_players(reader: &mut Reader<'_>, state: &mut State) -> Result<(), Error> {
    for _ in 0..reader.count(12)? {
        let client = reader.u32()?;
        let ball = Some(reader.u64()?).filter(|&id| id != NO_BALL);
        state.players.push(Player { client, ball });
    }
    if state.players.is_sorted_by(|a, b| a.client < b.client) {
        return Ok(());
    }
    Err(Error::Snapshot("snapshot's players must ascend by client".into()))
}

fn read_held(reader: &mut Reader<'_>, state: &mut State) -> Result<(), Error> {
    for _ in 0..reader.count(29)? {
        let client = reader.u32()?;
        let kind = match reader.u8()? {
            0 => HeldKind::Thrust,
            1 => HeldKind::Attract,
            other => {
                return Err(Error::Snapshot(format!(
                    "snapshot holds an input of kind {other}, the last is 1"
                )));
            }
        };
        let (vector, strength): (Vec2, f64) = (reader.vec2()?, reader.f64()?);
        if !(vector.is_finite() && strength.is_finite()) {
            return Err(Error::Snapshot(format!(
                "snapshot holds {vector:?}, {strength}: they must be finite"
            )));
        }
        state.held.push(Held {
            client,
            kind,
            vector,
            strength,
        });
    }
    if state
        .held
        .is_sorted_by(|a, b| (a.client, a.kind) < (b.client, b.kind))
    {
        return Ok(());
    }
    Err(Error::Snapshot(
        "snapshot's held inputs must ascend by client and kind".into(),
    ))
}
