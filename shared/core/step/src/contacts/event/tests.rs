//! Groups, in any number of strips, against all events in one sequence, the judge: every bit of every tick.

use proptest::prelude::*;

use super::EventDriven;
use super::groups::Grouped;
use crate::{Error, Model, NewBall, Rules, Team, Vec2, World, random};

/// A scene that is hard on the order of events.
#[derive(Clone, Debug)]
struct Scene {
    balls: Vec<NewBall>,
    side: f64,
    walls: bool,
    restitution: f64,
    forces: Vec<(&'static str, Vec<f64>)>,
}

impl Scene {
    fn world(&self, broadphase: &str, grouped: Option<Grouped>, threads: usize) -> World {
        let forces: Vec<(&str, &[f64])> = (self.forces.iter())
            .map(|(name, numbers)| (*name, &numbers[..]))
            .collect();
        let bounds = [0.0, 0.0, self.side, self.side];
        let rules = Rules::new(bounds, self.walls, self.restitution, 60.0, &forces).unwrap();
        let model = Model::new("verlet", "event", broadphase, 1, None).unwrap();
        let mut world = World::new(rules, model, &self.balls).unwrap();
        world.treat_contacts_by(Box::new(EventDriven::new(grouped)));
        world.employ(Team::new(threads).unwrap());
        world
    }

    /// A crowd of equal balls, `room` square metres each.
    fn crowd(count: u64, room: f64, speed: f64) -> Scene {
        let side = (room * count as f64).sqrt();
        let balls = (0..count).map(|i| {
            let number = |stream| random::uniform(5, stream, i);
            NewBall {
                position: Vec2::new(side * number(0), side * number(1)),
                velocity: Vec2::new(speed * (number(2) - 0.5), speed * (number(3) - 0.5)),
                radius: 0.3,
                mass: 1.0,
            }
        });
        Scene {
            balls: balls.collect(),
            side,
            walls: true,
            restitution: 1.0,
            forces: vec![],
        }
    }
}

/// Coordinates at random, on lines where trees split, outside the box, in one spot, next to nothing.
fn coordinate(side: f64) -> impl Strategy<Value = f64> {
    prop_oneof![
        12 => 0.0..side,
        3 => (0..=8u8).prop_map(move |eighths| side * f64::from(eighths) / 8.0),
        1 => (-0.5 * side)..(1.5 * side),
        1 => Just(0.5 * side),
        1 => prop_oneof![Just(0.0), Just(-0.0), Just(5e-324), Just(-1e-310)],
    ]
}

fn speed() -> impl Strategy<Value = f64> {
    prop_oneof![
        12 => -60.0..60.0f64,
        2 => prop_oneof![Just(0.0), Just(-0.0), Just(5e-324)],
        2 => (-3..=3i8).prop_map(|whole| 10.0 * f64::from(whole)),
        1 => -2000.0..2000.0f64,
    ]
}

fn ball(side: f64, alike: bool) -> impl Strategy<Value = NewBall> {
    let radius = if alike {
        Just(0.4).boxed()
    } else {
        prop_oneof![8 => 0.1..0.8f64, 1 => Just(0.01), 1 => Just(0.1 * side)].boxed()
    };
    let mass = if alike {
        Just(1.0).boxed()
    } else {
        prop_oneof![8 => 0.1..10.0f64, 1 => Just(f64::INFINITY)].boxed()
    };
    let place = (coordinate(side), coordinate(side));
    (place, (speed(), speed()), radius, mass).prop_map(|((x, y), (u, v), radius, mass)| NewBall {
        position: Vec2::new(x, y),
        velocity: if mass.is_infinite() {
            Vec2::ZERO
        } else {
            Vec2::new(u, v)
        },
        radius,
        mass,
    })
}

fn scene(most: usize) -> impl Strategy<Value = Scene> {
    let forces = prop_oneof![
        2 => Just(vec![]),
        2 => Just(vec![("gravity", vec![0.0, -10.0])]),
        1 => Just(vec![("gravity", vec![0.0, -10.0]), ("drag", vec![0.5])]),
    ];
    (any::<bool>(), 1.0..8.0f64, 2..most).prop_flat_map(move |(alike, room, count)| {
        let side = (room * count as f64).sqrt();
        let balls = prop::collection::vec(ball(side, alike), count);
        let restitution = prop_oneof![2 => Just(1.0), 1 => Just(0.7)];
        (balls, any::<bool>(), restitution, forces.clone()).prop_map(
            move |(balls, walls, restitution, forces)| Scene {
                balls,
                side,
                walls,
                restitution,
                forces,
            },
        )
    })
}

/// All that a tick leaves, or its error.
fn tick(world: &mut World, budget: u64) -> Result<(u64, Vec<u8>), String> {
    world
        .step_within(&[], None, budget)
        .map_err(|error| error.to_string())?;
    Ok((world.state_hash(), world.snapshot()))
}

/// The least budget with which events in sequence make the next tick; all that there is if none does.
fn least_budget(world: &World) -> u64 {
    let enough = |budget: u64| {
        let mut world = world.clone();
        world.treat_contacts_by(Box::new(EventDriven::new(None)));
        world.step_within(&[], None, budget).is_ok()
    };
    if !enough(u64::MAX) {
        return u64::MAX;
    }
    if enough(0) {
        return 0;
    }
    let (mut refused, mut least) = (0, 1);
    while !enough(least) {
        (refused, least) = (least, 4 * least);
    }
    while least - refused > 1 {
        let budget = refused.midpoint(least);
        if enough(budget) {
            least = budget;
        } else {
            refused = budget;
        }
    }
    least
}

fn check(scene: &Scene, ticks: usize) -> Result<(), TestCaseError> {
    let mut judge = scene.world("brute", None, 1);
    let mut others = [
        ("brute", 100, 1),
        ("quadtree", 3, 2),
        ("loose_quadtree", 1, 1),
        ("loose_quadtree", 8, 2),
        ("loose_quadtree", 3, 3),
    ]
    .map(|(broadphase, grain, threads)| {
        let grouped = Some(Grouped::with_strips_of(grain));
        let name = format!("{broadphase}, strips of {grain} balls, {threads} threads");
        (name, scene.world(broadphase, grouped, threads))
    });
    for number in 0..ticks {
        // Looking for it takes many ticks.
        let budget = if number % 5 == 2 {
            least_budget(&judge)
        } else {
            u64::MAX
        };
        let expected = tick(&mut judge, budget);
        for (name, other) in &mut others {
            if expected.is_ok() && (1..u64::MAX).contains(&budget) {
                let refused = other.step_within(&[], None, budget - 1);
                let refused = matches!(refused, Err(Error::Budget { .. }));
                prop_assert!(refused, "{name}, tick {number}, less than {budget} pairs");
            }
            prop_assert!(tick(other, budget) == expected, "{name}, tick {number}");
        }
        if expected.is_err() {
            break;
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, max_shrink_iters: 200, ..ProptestConfig::default() })]

    #[test]
    fn groups_are_as_good_as_a_sequence(scene in scene(40)) {
        check(&scene, 4)?;
    }
}

/// Fast balls: groups meet, are taken back and run together, again and again.
#[test]
fn groups_that_meet_run_as_one() {
    for (room, speed) in [(3.0, 40.0), (1.5, 60.0), (2.0, 200.0), (6.0, 600.0)] {
        check(&Scene::crowd(400, room, speed), 20).unwrap();
    }
}

/// Under gravity without loss, and below restitution 1 without forces.
#[test]
fn groups_know_parabolas_and_losses() {
    let gravity = vec![("gravity", vec![0.0, -10.0])];
    for (restitution, forces) in [(1.0, gravity), (0.8, vec![])] {
        let scene = Scene {
            restitution,
            forces,
            ..Scene::crowd(400, 1.5, 30.0)
        };
        check(&scene, 40).unwrap();
    }
}
