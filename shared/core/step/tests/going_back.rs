//! A tick that fails leaves the world as it was before, whatever it had changed by then.

use kuglice_step::{Error, Model, NewBall, Rules, Team, Vec2, World, random};

/// So short that even the fastest balls stay where they are.
const DT: f64 = 1e-311;

/// Balls that overlap each other and walls, the last two so fast that their velocities overflow.
fn world(substeps: u32, forces: &[(&str, &[f64])], least_radius: f64) -> World {
    let (columns, pitch) = (60, 0.9);
    let side = f64::from(columns) * pitch;
    let mut balls: Vec<NewBall> = (0..columns * columns)
        .map(|i| {
            let number = |stream| random::uniform(5, stream, i as u64);
            NewBall {
                position: Vec2::new(f64::from(i % columns) + 0.5, f64::from(i / columns) + 0.5) * pitch,
                velocity: Vec2::new(120.0 * number(0) - 60.0, 120.0 * number(1) - 60.0),
                radius: least_radius + (0.5 - least_radius) * number(2),
                mass: 1.0,
            }
        })
        .collect();
    let last = balls.len() - 1;
    balls[last].position = balls[last - 1].position + Vec2::new(1.0, 0.0) * least_radius;
    balls[last - 1].velocity = Vec2::new(1.7e308, 0.0);
    balls[last].velocity = Vec2::new(-1.7e308, 0.0);
    let rules = Rules::new([0.0, 0.0, side, side], true, 1.0, 60.0, forces).unwrap();
    let model = Model::new("verlet", "overlap", "loose_quadtree", substeps, None).unwrap();
    World::new(rules, model, &balls).unwrap()
}

#[test]
fn a_tick_that_fails_has_changed_nothing() {
    let gravity: &[(&str, &[f64])] = &[("gravity", &[0.0, -10.0])];
    for (substeps, forces, least_radius) in [
        (1, &[][..], 0.5),
        (2, &[], 0.1),
        (1, gravity, 0.5),
        (2, gravity, 0.1),
    ] {
        for threads in [1, 3] {
            let mut world = world(substeps, forces, least_radius);
            world.employ(Team::new(threads).unwrap());
            let before = (world.snapshot(), world.state().clone());
            let failed = world.step(&[], Some(DT)).unwrap_err();
            assert!(matches!(failed, Error::Diverged { tick: 0, .. }), "{failed}");
            assert_eq!((world.snapshot(), world.state()), (before.0, &before.1));
        }
    }
}

#[test]
fn such_a_tick_would_have_changed_much_without_those_two() {
    let mut world = world(1, &[], 0.5);
    let mut balls: Vec<NewBall> = Vec::new();
    let state = world.state();
    for index in 0..state.balls.len() - 2 {
        balls.push(NewBall {
            position: state.balls.position[index],
            velocity: state.balls.velocity[index],
            radius: state.balls.radius[index],
            mass: state.balls.mass[index],
        });
    }
    world = World::new(world.rules().clone(), world.model().clone(), &balls).unwrap();
    world.step(&[], Some(DT)).unwrap();
    let counters = world.state().counters;
    assert!(
        counters.collisions > 100 && counters.wall_hits > 10,
        "{counters:?}"
    );
}
