//! A tick that fails leaves the world as it was before, whatever had moved by then.

use kuglice_step::{Error, Model, NewBall, Rules, Vec2, World, random};

const COUNT: u64 = 900;
/// Seconds; in each such tick many balls collide.
const LENGTH: f64 = 0.2;

/// A gas, and one ball so far away and so fast that it runs out of numbers within a tick, but not within half of one.
fn world(contacts: &str, substeps: u32) -> World {
    let mut balls: Vec<_> = (0..COUNT)
        .map(|i| NewBall {
            position: Vec2::new(1.0 + 1.2 * (i % 30) as f64, 1.0 + 1.2 * (i / 30) as f64),
            velocity: Vec2::new(random::uniform(1, 0, i) - 0.5, random::uniform(1, 1, i) - 0.5),
            radius: 0.5,
            mass: 1.0,
        })
        .collect();
    for ball in &mut balls {
        ball.velocity = ball.velocity * 6.0;
    }
    balls.push(NewBall {
        position: Vec2::new(1.7e308, 0.0),
        velocity: Vec2::new(6e307, 0.0),
        ..balls[0]
    });
    let rules = Rules::new([0.0, 0.0, 60.0, 60.0], false, 1.0, 60.0, &[]).unwrap();
    let model = Model::new("verlet", contacts, "loose_quadtree", substeps, None).unwrap();
    World::new(rules, model, &balls).unwrap()
}

#[test]
fn a_ball_that_runs_out_of_numbers_fails_the_tick() {
    for contacts in ["overlap", "backtrack", "event"] {
        for substeps in [1, 2] {
            let mut world = world(contacts, substeps);
            let (before, hash) = (world.snapshot(), world.state_hash());
            let done = world.step(&[], Some(LENGTH));
            assert!(
                matches!(done, Err(Error::Diverged { ball: COUNT, .. })),
                "{contacts}, {substeps} substeps: {done:?}"
            );
            assert_eq!(world.snapshot(), before);
            assert_eq!(world.state_hash(), hash);
            world.step(&[], Some(0.25 * LENGTH)).unwrap();
            assert!(world.state().counters.collisions > 0);
        }
    }
}

#[test]
fn a_tick_that_looks_at_too_much_changes_nothing() {
    for substeps in [1, 2] {
        let mut world = world("event", substeps);
        let before = world.snapshot();
        let mut enough = 1;
        while let Err(error) = world.step_within(&[], Some(0.25 * LENGTH), enough) {
            assert!(matches!(error, Error::Budget { .. }), "{error}");
            assert_eq!(world.snapshot(), before);
            enough += 1 + enough / 8;
        }
        // Of those ticks some failed after balls had collided: fewer pairs than half the balls are near each other at first.
        assert!(enough > COUNT / 2 && world.state().counters.collisions > 0);
    }
}
