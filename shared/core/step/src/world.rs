//! A world: a state, the rules and the model that step it, and scratch memory that no result depends on.

mod ticks;
mod told;

use std::sync::Arc;

use crate::broadphase::{Broadphase, Pair};
use crate::contacts::{Contacts, Pairs};
use crate::last::Last;
use crate::snapshot::Saving;
use crate::{Error, Input, Model, NewBall, Rules, State, Team, Vec2, energy, hash, snapshot};

/// A simulation that can be stepped, copied, saved and restored.
pub struct World {
    rules: Arc<Rules>,
    model: Model,
    state: State,
    contacts: Box<dyn Contacts>,
    broadphase: Box<dyn Broadphase>,
    last: Last,
    inputs: Vec<Input>,
    /// Ticks until the balls are put in spatial order again.
    until_arranged: u32,
    team: Team,
}

impl Clone for World {
    fn clone(&self) -> World {
        World {
            until_arranged: self.until_arranged,
            team: self.team.clone(),
            ..World::with_state(Arc::clone(&self.rules), self.model.clone(), self.state.clone())
        }
    }
}

impl World {
    /// A world at tick 0; balls get the ids 0, 1, ... in their order.
    ///
    /// # Errors
    /// [`Error::Scene`] if a ball is out of bounds, or there are more than 2^32 - 1.
    pub fn new(rules: Rules, model: Model, balls: &[NewBall]) -> Result<World, Error> {
        if u32::try_from(balls.len()).is_err() {
            return Err(Error::Scene(format!(
                "{} balls are given, at most {} can be",
                balls.len(),
                u32::MAX
            )));
        }
        let mut state = State::default();
        for (id, ball) in (0u64..).zip(balls) {
            ball.check()
                .map_err(|error| Error::Scene(format!("ball {id}: {error}")))?;
            state.balls.push(id, *ball);
            state.next_id = id + 1;
        }
        Ok(World::with_state(Arc::new(rules), model, state))
    }

    /// A world that goes on from a snapshot.
    ///
    /// # Errors
    /// [`Error::Snapshot`] if the bytes are not a snapshot of this step version.
    pub fn restore(rules: Rules, model: Model, bytes: &[u8]) -> Result<World, Error> {
        Ok(World::with_state(Arc::new(rules), model, snapshot::read(bytes)?))
    }

    fn with_state(rules: Arc<Rules>, model: Model, state: State) -> World {
        let contacts = model.make_contacts();
        let broadphase = model.make_broadphase(&rules);
        World {
            rules,
            model,
            state,
            contacts,
            broadphase,
            last: Last::default(),
            inputs: Vec::new(),
            until_arranged: 0,
            team: Team::default(),
        }
    }

    /// Becomes a copy of `other`, in the memory that is there.
    pub fn copy_from(&mut self, other: &World) {
        if !Arc::ptr_eq(&self.rules, &other.rules) {
            *self = other.clone();
            return;
        }
        self.state.clone_from(&other.state);
        self.until_arranged = other.until_arranged;
    }

    /// Lets `team` do the work from now on: how many threads there are shows in nothing but time.
    pub fn employ(&mut self, team: Team) {
        self.team = team;
    }

    /// Replaces the treatment of contacts: tests compare two ways of one.
    #[cfg(test)]
    pub(crate) fn treat_contacts_by(&mut self, contacts: Box<dyn Contacts>) {
        self.contacts = contacts;
    }

    /// Who does the work.
    #[must_use]
    pub fn team(&self) -> &Team {
        &self.team
    }

    /// The state.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The rules.
    #[must_use]
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Simulated seconds.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.rules.time(&self.state)
    }

    /// The 64 bits that stand for the state.
    #[must_use]
    pub fn state_hash(&self) -> u64 {
        hash::state(&self.state, &self.team)
    }

    /// The state as bytes.
    #[must_use]
    pub fn snapshot(&self) -> Vec<u8> {
        let saving = self.saving();
        let mut bytes = vec![0; saving.len()];
        saving.write_to(&mut bytes);
        bytes
    }

    /// The same, to be written to memory that somebody else has.
    #[must_use]
    pub fn saving(&self) -> Saving<'_> {
        Saving::new(&self.state)
    }

    /// Kinetic energy of the balls that can move.
    #[must_use]
    pub fn kinetic_energy(&self) -> f64 {
        energy::kinetic(&self.state)
    }

    /// Potential energy of the balls that can move.
    #[must_use]
    pub fn potential_energy(&self) -> f64 {
        energy::potential(&self.rules, &self.state)
    }

    /// Momentum of the balls that can move.
    #[must_use]
    pub fn momentum(&self) -> Vec2 {
        energy::momentum(&self.state)
    }

    /// All pairs that overlap now, as indices, the lower id first, in order of the ids.
    pub fn overlapping(&mut self) -> Vec<Pair> {
        let mut pairs = Pairs::<()>::default();
        pairs.find_overlapping(&self.state.balls, &mut *self.broadphase, &self.team);
        pairs.sorted(&self.state.balls)
    }

    /// Rectangles of the occupied nodes of a quadtree over the balls as they are now.
    #[must_use]
    pub fn nodes(&self) -> Vec<[f64; 4]> {
        let name = if self.model.broadphase() == "quadtree" {
            "quadtree"
        } else {
            "loose_quadtree"
        };
        let model = Model::new("verlet", "overlap", name, 1, self.model.smallest_node());
        let Ok(model) = model else { return Vec::new() };
        let mut tree = model.make_broadphase(&self.rules);
        Pairs::<()>::default().find(&self.state.balls, &mut *tree, &self.team);
        tree.nodes()
    }
}
