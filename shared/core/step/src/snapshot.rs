//! Snapshots: a whole state as bytes, versioned and checksummed. What is restored continues bit for bit.

use crate::codec::{Reader, Writer};
use crate::{Counters, Error, Held, HeldKind, NO_BALL, NewBall, Player, State, Vec2};

const MAGIC: &[u8; 4] = b"KGSN";
const VERSION: u32 = 1;
const WHAT: &str = "snapshot";

/// Writes a state.
pub(crate) fn write(state: &State) -> Vec<u8> {
    let balls = &state.balls;
    let mut writer = Writer::new(MAGIC, VERSION);
    writer.reserve(128 + balls.len() * 56 + state.players.len() * 12 + state.held.len() * 29);
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
    writer.count(balls.len());
    match balls.uniform() {
        Some(shape) => {
            writer.u8(1);
            writer.f64(shape.radius);
            writer.f64(shape.mass);
        }
        None => {
            writer.u8(0);
            for index in balls.by_id() {
                writer.f64(balls.radius[index]);
                writer.f64(balls.mass[index]);
            }
        }
    }
    for index in balls.by_id() {
        writer.u64(balls.id[index]);
    }
    for index in balls.by_id() {
        writer.vec2(balls.position[index]);
    }
    for index in balls.by_id() {
        writer.vec2(balls.velocity[index]);
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
    writer.seal()
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
    let uniform = reader.u8()? != 0;
    let shapes = if uniform {
        vec![(reader.f64()?, reader.f64()?); count]
    } else {
        (0..count)
            .map(|_| Ok((reader.f64()?, reader.f64()?)))
            .collect::<Result<_, Error>>()?
    };
    let ids = (0..count).map(|_| reader.u64()).collect::<Result<Vec<_>, _>>()?;
    if !ids.is_sorted_by(|a, b| a < b) || ids.last().is_some_and(|&last| last >= state.next_id) {
        return Err(Error::Snapshot(format!(
            "snapshot's ball ids must ascend and stay below the next id, {}",
            state.next_id
        )));
    }
    let positions = (0..count).map(|_| reader.vec2()).collect::<Result<Vec<_>, _>>()?;
    for index in 0..count {
        let (radius, mass) = shapes[index];
        let ball = NewBall {
            position: positions[index],
            velocity: reader.vec2()?,
            radius,
            mass,
        };
        ball.check()
            .map_err(|error| Error::Snapshot(format!("ball {} of the snapshot: {error}", ids[index])))?;
        state.balls.push(ids[index], ball);
    }
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
