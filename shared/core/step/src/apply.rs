//! Applying the inputs of a tick to the state, in their total order.

use crate::{Held, HeldKind, Input, InputKind, NO_BALL, NewBall, Player, State, Vec2};

/// Applies all inputs. One that cannot take effect (a ball that is gone, a second join) changes nothing but a counter:
/// what every machine ignores alike cannot make them differ.
pub(crate) fn inputs(state: &mut State, inputs: &mut [Input]) {
    inputs.sort_unstable_by(Input::order);
    for input in inputs.iter() {
        if input.is_finite() && input_takes_effect(state, input) {
            state.counters.inputs_applied += 1;
        } else {
            state.counters.inputs_ignored += 1;
        }
    }
}

fn input_takes_effect(state: &mut State, input: &Input) -> bool {
    let [a, b, c, d, e, f] = input.numbers;
    match input.kind {
        InputKind::Join => join(
            state,
            input.client,
            NewBall {
                position: Vec2::new(a, b),
                velocity: Vec2::ZERO,
                radius: c,
                mass: d,
            },
        ),
        InputKind::Leave => leave(state, input.client),
        InputKind::Spawn => {
            let ball = NewBall {
                position: Vec2::new(a, b),
                velocity: Vec2::new(c, d),
                radius: e,
                mass: f,
            };
            spawn(state, ball).is_some()
        }
        InputKind::Remove => remove(state, input.ball),
        InputKind::Thrust => {
            let held = Held {
                client: input.client,
                kind: HeldKind::Thrust,
                vector: Vec2::new(a, b),
                strength: 0.0,
            };
            // Without a ball there is nothing to thrust.
            state.own_ball(input.client).is_some() && hold_or_release(state, held, a == 0.0 && b == 0.0)
        }
        InputKind::Attract => {
            let held = Held {
                client: input.client,
                kind: HeldKind::Attract,
                vector: Vec2::new(a, b),
                strength: c,
            };
            hold_or_release(state, held, c == 0.0)
        }
        InputKind::Kick => kick(state, input.client, input.ball, Vec2::new(a, b)),
    }
}

fn join(state: &mut State, client: u32, ball: NewBall) -> bool {
    let Err(at) = state
        .players
        .binary_search_by_key(&client, |player| player.client)
    else {
        return false;
    };
    let owned = if ball.radius == 0.0 {
        None
    } else {
        spawn(state, ball)
    };
    if ball.radius != 0.0 && owned.is_none() {
        return false;
    }
    state.players.insert(at, Player { client, ball: owned });
    true
}

fn leave(state: &mut State, client: u32) -> bool {
    let Ok(at) = state
        .players
        .binary_search_by_key(&client, |player| player.client)
    else {
        return false;
    };
    let player = state.players.remove(at);
    state.held.retain(|held| held.client != client);
    if let Some(index) = player.ball.and_then(|id| state.balls.index_of(id)) {
        state.balls.remove(index);
    }
    true
}

fn spawn(state: &mut State, ball: NewBall) -> Option<u64> {
    ball.check().ok()?;
    let id = state.next_id;
    state.next_id += 1;
    state.balls.push(id, ball);
    Some(id)
}

fn remove(state: &mut State, id: u64) -> bool {
    let Some(index) = state.balls.index_of(id) else {
        return false;
    };
    state.balls.remove(index);
    for player in &mut state.players {
        if player.ball == Some(id) {
            player.ball = None;
        }
    }
    true
}

fn hold_or_release(state: &mut State, held: Held, release: bool) -> bool {
    if release {
        state.release(held.client, held.kind);
    } else {
        state.hold(held);
    }
    true
}

fn kick(state: &mut State, client: u32, id: u64, change: Vec2) -> bool {
    let index = if id == NO_BALL {
        state.own_ball(client)
    } else {
        state.balls.index_of(id)
    };
    match index {
        Some(index) if state.balls.mass[index].is_finite() => {
            state.balls.velocity[index] += change;
            true
        }
        _ => false,
    }
}
