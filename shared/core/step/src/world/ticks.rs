//! The tick of a world.

use super::World;
use crate::contacts::Substep;
use crate::error::Shown;
use crate::force::{Field, HeldNow};
use crate::{Error, Input, apply};

/// Balls that are fewer than this stay in id order: the nearest cache holds them all.
const FEW_BALLS: usize = 2048;
/// Ticks after which neighbours have drifted so far apart in memory that arranging them pays.
const ARRANGED_TICKS: u32 = 23;

impl World {
    /// One tick: inputs, forces, move, contacts, walls. `dt` replaces the scene's tick length.
    ///
    /// # Errors
    /// [`Error::Diverged`] or [`Error::EventLimit`]; the world then stays as it was before.
    pub fn step(&mut self, inputs: &[Input], dt: Option<f64>) -> Result<(), Error> {
        self.step_within(inputs, dt, u64::MAX)
    }

    /// As [`World::step`], with a bound on the work: the pairs of balls that `event` looks at because their paths may
    /// cross, and the events, in each substep its equal share of them. Like all that comes of a step, whether it is made
    /// depends on nothing but the state, the inputs, the model, `dt` and `budget`.
    ///
    /// # Errors
    /// Those of [`World::step`], and [`Error::Budget`].
    pub fn step_within(&mut self, inputs: &[Input], dt: Option<f64>, budget: u64) -> Result<(), Error> {
        if let Some(dt) = dt.filter(|dt| !(dt.is_finite() && *dt > 0.0)) {
            return Err(Error::Input(format!(
                "dt is {} s, it must be above 0 and finite",
                Shown(dt)
            )));
        }
        let team = self.team.clone();
        team.enter(|| {
            self.last.begin(&self.state, !inputs.is_empty());
            let done = self.try_step(inputs, dt, budget);
            match done {
                Ok(()) => self.arrange(),
                Err(_) => self.last.go_back(&mut self.state),
            }
            done
        })
    }

    /// Puts neighbours near each other in memory, now and then. No result depends on it.
    fn arrange(&mut self) {
        let balls = &mut self.state.balls;
        if balls.len() < FEW_BALLS {
            return;
        }
        if self.until_arranged > 0 {
            self.until_arranged -= 1;
            return;
        }
        self.until_arranged = ARRANGED_TICKS;
        if let Some(order) = self.broadphase.order() {
            let (kept, back) = self.last.spare();
            let spare = self.contacts.spare().unwrap_or(kept);
            balls.arrange(order, spare, back, &self.team);
        }
    }

    fn try_step(&mut self, inputs: &[Input], dt: Option<f64>, budget: u64) -> Result<(), Error> {
        let state = &mut self.state;
        self.inputs.clear();
        self.inputs.extend_from_slice(inputs);
        apply::inputs(state, &mut self.inputs);

        let start = self.rules.time(state);
        let whole = dt.unwrap_or(1.0 / self.rules.tick_rate());
        let part = whole / f64::from(self.model.substeps());
        let field = Field::new(self.rules.forces(), &state.balls, HeldNow::of(state));
        // Of several substeps, one may fail when others have moved the balls.
        if !self.contacts.keeps_last() || self.model.substeps() > 1 {
            self.last.keep(&state.balls, &self.team);
        }
        let mut finite = false;
        for substep in 0..self.model.substeps() {
            self.contacts.advance(&mut Substep {
                rules: &self.rules,
                balls: &mut state.balls,
                counters: &mut state.counters,
                field: &field,
                integrator: self.model.integrator(),
                broadphase: &mut *self.broadphase,
                team: &self.team,
                tick: state.tick,
                time: start + f64::from(substep) * part,
                dt: part,
                budget: budget / u64::from(self.model.substeps()),
                last: &mut self.last,
                finite: &mut finite,
            })?;
        }
        if !finite && let Some(ball) = state.balls.first_not_finite(&self.team) {
            return Err(Error::Diverged {
                tick: state.tick,
                ball,
            });
        }
        state.tick += 1;
        if let Some(dt) = dt {
            state.variable_ticks += 1;
            state.variable_time += dt;
        }
        Ok(())
    }
}
