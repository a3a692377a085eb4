//! The state: all that a tick reads and writes, all that is hashed, all that a snapshot holds.

use crate::{Balls, Vec2};

/// How often things happened since the world began.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Impulses between two balls.
    pub collisions: u64,
    /// Impulses between a ball and a wall.
    pub wall_hits: u64,
    /// Inputs that took effect.
    pub inputs_applied: u64,
    /// Inputs that could not take effect, such as the removal of a ball that is no longer there.
    pub inputs_ignored: u64,
}

/// Someone who joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Player {
    /// The client's number.
    pub client: u32,
    /// Id of the ball that it owns.
    pub ball: Option<u64>,
}

/// What kind of input can be held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HeldKind {
    /// A force on the player's own ball.
    Thrust,
    /// A point that attracts every ball.
    Attract,
}

/// An input that acts until it is changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Held {
    /// The client's number.
    pub client: u32,
    /// What is held.
    pub kind: HeldKind,
    /// Force of a thrust, point of an attraction.
    pub vector: Vec2,
    /// Strength of an attraction; 0 for a thrust.
    pub strength: f64,
}

/// The state of a world between two ticks.
#[derive(Debug, Default, PartialEq)]
pub struct State {
    /// Ticks done.
    pub tick: u64,
    /// Ticks done with a length of their own (the `variable` loop).
    pub variable_ticks: u64,
    /// Seconds that those took.
    pub variable_time: f64,
    /// The id that the next ball gets.
    pub next_id: u64,
    /// Counters of what happened.
    pub counters: Counters,
    /// The balls.
    pub balls: Balls,
    /// Who plays, by client number.
    pub players: Vec<Player>,
    /// What is held, by client number, then kind.
    pub held: Vec<Held>,
}

impl Clone for State {
    fn clone(&self) -> State {
        let mut copy = State::default();
        copy.clone_from(self);
        copy
    }

    fn clone_from(&mut self, source: &State) {
        self.tick = source.tick;
        self.variable_ticks = source.variable_ticks;
        self.variable_time = source.variable_time;
        self.next_id = source.next_id;
        self.counters = source.counters;
        self.balls.clone_from(&source.balls);
        self.players.clone_from(&source.players);
        self.held.clone_from(&source.held);
    }
}

impl State {
    /// Simulated seconds since the world began.
    #[must_use]
    pub fn time(&self, tick_rate: f64) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "exact below 2^53 ticks")]
        let fixed = (self.tick - self.variable_ticks) as f64 / tick_rate;
        fixed + self.variable_time
    }

    /// The ball that a client owns, as an index.
    #[must_use]
    pub fn own_ball(&self, client: u32) -> Option<usize> {
        let at = self
            .players
            .binary_search_by_key(&client, |player| player.client)
            .ok()?;
        self.balls.index_of(self.players[at].ball?)
    }

    /// Starts or replaces what a client holds of one kind.
    pub(crate) fn hold(&mut self, held: Held) {
        match self
            .held
            .binary_search_by_key(&(held.client, held.kind), |h| (h.client, h.kind))
        {
            Ok(at) => self.held[at] = held,
            Err(at) => self.held.insert(at, held),
        }
    }

    /// Ends what a client holds of one kind.
    pub(crate) fn release(&mut self, client: u32, kind: HeldKind) {
        self.held
            .retain(|held| held.client != client || held.kind != kind);
    }
}
