//! The step of Kuglice: `state(n+1) = step(state(n), inputs(n), model)`, a pure function.
//!
//! Only `+ - * /` and `sqrt` on f64 are used, every order that can change a sum is fixed by ball id, event time,
//! client and sequence number, and nothing is carried from tick to tick but the [`State`]. That is why a server, its
//! clients and a replay agree in every bit, on every platform.
//!
//! ```
//! use kuglice_step::{Model, NewBall, Rules, Vec2, World};
//!
//! let rules = Rules::new([0.0, 0.0, 20.0, 10.0], true, 1.0, 60.0, &[("gravity", &[0.0, -10.0])])?;
//! let model = Model::new("verlet", "overlap", "loose_quadtree", 1, None)?;
//! let ball = NewBall { position: Vec2::new(5.0, 5.0), velocity: Vec2::new(1.0, 0.0), radius: 0.5, mass: 1.0 };
//! let mut world = World::new(rules, model, &[ball])?;
//! world.step(&[], None)?;
//! assert_eq!(world.state().tick, 1);
//! # Ok::<(), kuglice_step::Error>(())
//! ```
#![forbid(unsafe_code)]

mod apply;
mod balls;
pub mod broadphase;
mod checksum;
mod codec;
pub mod contacts;
mod energy;
mod error;
pub mod force;
mod hash;
mod input;
pub mod integrator;
mod last;
mod model;
mod order;
pub mod random;
mod recording;
mod rules;
mod snapshot;
mod state;
mod team;
mod vec2;
mod walls;
mod world;

pub use balls::{Balls, NewBall, Uniform};
pub use error::Error;
pub use input::{INPUT_BYTES, Input, InputKind, NO_BALL, read_inputs, write_inputs};
pub use model::Model;
pub use recording::Recording;
pub use rules::Rules;
pub use snapshot::{Saving, Slot};
pub use state::{Counters, Held, HeldKind, Player, State};
pub use team::{MOST_THREADS, Team};
pub use vec2::Vec2;
pub use world::World;

/// Changes when, and only when, some state would step to other bits than before.
pub const STEP_VERSION: u32 = 2;
