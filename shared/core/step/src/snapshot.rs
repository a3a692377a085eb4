//! Snapshots: a whole state as bytes, versioned and checksummed. What is restored continues bit for bit.
//!
//! First all but the balls, filled up with zeros to whole rows of the checksum; then columns in the order of the ids:
//! radius and mass where they differ, positions, velocities, ids; then the checksum. Numbers are little-endian. Equal
//! states give equal bytes, wherever their balls are in memory.

mod saving;

pub use saving::{Saving, Slot};

use crate::codec::Reader;
use crate::{Balls, Counters, Error, Held, HeldKind, NO_BALL, Player, State, Vec2};

const MAGIC: &[u8; 4] = b"KGSN";
/// 2: the checksum is computed in lanes. 3: it is made of sums, over columns that begin where its rows do.
const VERSION: u32 = 3;
const WHAT: &str = "snapshot";

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
    read_players(&mut reader, &mut state)?;
    read_held(&mut reader, &mut state)?;
    read_balls(&mut reader, &mut state)?;
    reader.end()?;
    Ok(state)
}

fn read_balls(reader: &mut Reader<'_>, state: &mut State) -> Result<(), Error> {
    let count = reader.count(40)?;
    let shared = match reader.u8()? {
        0 => None,
        _ => Some((reader.f64()?, reader.f64()?)),
    };
    reader.filling()?;
    let number = |[one, other]: [u64; 2]| (f64::from_bits(one), f64::from_bits(other));
    let (radius, mass) = match shared {
        Some((radius, mass)) => (vec![radius; count], vec![mass; count]),
        None => reader.columns(count)?.map(number).unzip(),
    };
    let vector = |[x, y]: [u64; 2]| Vec2::new(f64::from_bits(x), f64::from_bits(y));
    let position = reader.columns(count)?.map(vector).collect();
    let velocity = reader.columns(count)?.map(vector).collect();
    let id: Vec<u64> = reader.columns::<1>(count)?.map(|[id]| id).collect();
    if !id.is_sorted_by(|a, b| a < b) || id.last().is_some_and(|&last| last >= state.next_id) {
        return Err(Error::Snapshot(format!(
            "snapshot's ball ids must ascend and stay below the next id, {}",
            state.next_id
        )));
    }
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
