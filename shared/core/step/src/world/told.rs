//! What a world is told by one who knows the truth: some balls, players and held inputs, in place.

use std::sync::Arc;

use super::World;
use crate::{Error, Held, Model, NO_BALL, NewBall, Player, Rules, State};

impl World {
    /// A world of some balls only, as somebody knows them at `tick`: what follows is a view of the whole as long as no
    /// other ball comes near. Ids ascend.
    ///
    /// # Errors
    /// As [`World::replace`].
    pub fn with_balls(
        rules: Rules,
        model: Model,
        tick: u64,
        balls: &[(u64, NewBall)],
    ) -> Result<World, Error> {
        let mut world = World::with_state(
            Arc::new(rules),
            model,
            State {
                tick,
                ..State::default()
            },
        );
        world.replace(&[], balls)?;
        Ok(world)
    }

    /// Takes the balls `gone` out (those that are there) and puts `told` in, or right where they are already there. Ids
    /// ascend in both; a ball that is in both stays as told.
    ///
    /// # Errors
    /// [`Error::Scene`] if ids do not ascend or are [`NO_BALL`](crate::NO_BALL), or a ball is out of bounds; the world
    /// then stays as it was before.
    pub fn replace(&mut self, gone: &[u64], told: &[(u64, NewBall)]) -> Result<(), Error> {
        check_ascending(gone.iter().copied())?;
        check_ascending(told.iter().map(|&(id, _)| id))?;
        for (id, ball) in told {
            ball.check()
                .map_err(|error| Error::Scene(format!("ball {id}: {error}")))?;
        }
        let state = &mut self.state;
        state.balls.replace(gone, told);
        if let Some(&(last, _)) = told.last() {
            state.next_id = state.next_id.max(last + 1);
        }
        Ok(())
    }

    /// Makes `players` and `held` all that there are: what somebody does who is told of no inputs. Clients ascend, and
    /// kinds within a client.
    ///
    /// # Errors
    /// [`Error::Input`] if they do not ascend, or a number is not finite; the world then stays as it was before.
    pub fn hold(&mut self, players: &[Player], held: &[Held]) -> Result<(), Error> {
        if !players.is_sorted_by(|a, b| a.client < b.client)
            || !held.is_sorted_by(|a, b| (a.client, a.kind) < (b.client, b.kind))
        {
            return Err(Error::Input(
                "players must ascend by client, held inputs by client and kind".into(),
            ));
        }
        if let Some(wrong) = held
            .iter()
            .find(|one| !(one.vector.is_finite() && one.strength.is_finite()))
        {
            return Err(Error::Input(format!(
                "client {} holds {:?}, {}: they must be finite",
                wrong.client, wrong.vector, wrong.strength
            )));
        }
        self.state.players.clear();
        self.state.players.extend_from_slice(players);
        self.state.held.clear();
        self.state.held.extend_from_slice(held);
        Ok(())
    }
}

fn check_ascending(ids: impl Iterator<Item = u64> + Clone) -> Result<(), Error> {
    let pairs = ids.clone().zip(ids.clone().skip(1));
    for (before, after) in pairs {
        if after <= before {
            return Err(Error::Scene(format!(
                "ball {after} is given after ball {before}: ids must ascend, each given once"
            )));
        }
    }
    match ids.last() {
        Some(NO_BALL) => Err(Error::Scene(format!(
            "{NO_BALL} stands for no ball, it can be no id"
        ))),
        _ => Ok(()),
    }
}
