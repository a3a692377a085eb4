//! A world of some of the balls: made of what is known of them, and put right in place when more is known.

use kuglice_step::{Error, Held, HeldKind, Model, NO_BALL, NewBall, Player, Rules, Vec2, World, random};

fn rules() -> Rules {
    Rules::new(
        [0.0, 0.0, 100.0, 60.0],
        true,
        1.0,
        60.0,
        &[("gravity", &[0.0, -1.0]), ("attract", &[0.5])],
    )
    .unwrap()
}

fn model(contacts: &str) -> Model {
    Model::new("verlet", contacts, "loose_quadtree", 1, None).unwrap()
}

fn ball(i: u64) -> NewBall {
    let number = |stream| random::uniform(11, stream, i);
    NewBall {
        position: Vec2::new(1.0 + 98.0 * number(0), 1.0 + 58.0 * number(1)),
        velocity: Vec2::new(20.0 * number(2) - 10.0, 20.0 * number(3) - 10.0),
        radius: 0.2,
        mass: 1.0,
    }
}

fn told(world: &World) -> Vec<(u64, NewBall)> {
    let balls = &world.state().balls;
    let one = |index: usize| NewBall {
        position: balls.position[index],
        velocity: balls.velocity[index],
        radius: balls.radius[index],
        mass: balls.mass[index],
    };
    balls.by_id().map(|index| (balls.id[index], one(index))).collect()
}

/// Memory order shows in nothing, so a world of all balls, made anew at any tick, goes on as the first one does.
#[test]
fn a_world_of_all_balls_goes_on_like_the_one_they_are_of() {
    for contacts in ["overlap", "event"] {
        let balls: Vec<_> = (0..2500).map(ball).collect();
        let mut whole = World::new(rules(), model(contacts), &balls).unwrap();
        (0..70).for_each(|_| whole.step(&[], None).unwrap());
        let known = told(&whole);
        let mut fresh = World::with_balls(rules(), model(contacts), 70, &known).unwrap();
        let mut updated = World::with_balls(rules(), model(contacts), 70, &[]).unwrap();
        let (odd, even): (Vec<_>, Vec<_>) = known.iter().copied().partition(|(id, _)| id % 2 == 1);
        let strangers: Vec<_> = (0..100).map(|i| (3000 + i, ball(i))).collect();
        let gone: Vec<u64> = strangers.iter().map(|&(id, _)| id).collect();
        updated.replace(&[], &odd).unwrap();
        updated.replace(&[], &strangers).unwrap();
        updated.replace(&gone, &even).unwrap();
        for world in [&mut whole, &mut fresh, &mut updated] {
            (0..70).for_each(|_| world.step(&[], None).unwrap());
        }
        assert!(whole.state().balls == fresh.state().balls);
        assert!(whole.state().balls == updated.state().balls);
        assert_eq!(fresh.state().tick, whole.state().tick);
    }
}

#[test]
fn balls_that_are_there_are_put_right_in_place() {
    let balls: Vec<_> = (0..2500).map(ball).collect();
    let mut world = World::new(rules(), model("overlap"), &balls).unwrap();
    world.step(&[], None).unwrap();
    assert!(!world.state().balls.is_by_id());
    let memory = world.state().balls.id.clone();
    let right = NewBall {
        radius: 0.3,
        ..ball(7)
    };
    world.replace(&[9000], &[(17, right)]).unwrap();
    assert_eq!(world.state().balls.id, memory);
    assert_eq!(told(&world)[17], (17, right));
    assert_eq!(world.state().balls.uniform(), None);
    world
        .replace(&[], &[(17, NewBall { radius: 0.2, ..right })])
        .unwrap();
    assert!(world.state().balls.uniform().is_some());
}

#[test]
fn what_cannot_be_is_refused_and_changes_nothing() {
    let mut world = World::with_balls(rules(), model("overlap"), 3, &[(5, ball(5))]).unwrap();
    let before = world.snapshot();
    let nan = NewBall {
        position: Vec2::new(f64::NAN, 0.0),
        ..ball(1)
    };
    let flat = NewBall {
        radius: 0.0,
        ..ball(1)
    };
    for (wrong, words) in [
        (
            vec![(7, ball(7)), (7, ball(8))],
            "ball 7 is given after ball 7: ids must ascend",
        ),
        (
            vec![(7, ball(7)), (6, ball(8))],
            "ball 6 is given after ball 7: ids must ascend",
        ),
        (vec![(6, nan)], "ball 6: a ball's position"),
        (
            vec![(6, flat)],
            "ball 6: a ball's radius is 0, it must be above 0",
        ),
        (vec![(NO_BALL, ball(1))], "stands for no ball"),
    ] {
        let Err(Error::Scene(told)) = world.replace(&[], &wrong) else {
            panic!("{words}")
        };
        assert!(told.contains(words), "{told}");
    }
    assert!(world.replace(&[2, 2], &[]).is_err());
    assert_eq!(world.snapshot(), before);
}

#[test]
fn what_is_held_acts_as_in_the_whole_world() {
    let balls: Vec<_> = (0..50).map(ball).collect();
    let attract = Held {
        client: 2,
        kind: HeldKind::Attract,
        vector: Vec2::new(50.0, 30.0),
        strength: 40.0,
    };
    let thrust = Held {
        client: 2,
        kind: HeldKind::Thrust,
        vector: Vec2::new(3.0, 0.0),
        strength: 0.0,
    };
    let mut world = World::new(rules(), model("overlap"), &balls).unwrap();
    let mut free = world.clone();
    let player = Player {
        client: 2,
        ball: Some(4),
    };
    world.hold(&[player], &[thrust, attract]).unwrap();
    assert!(world.hold(&[player, player], &[]).is_err());
    assert!(world.hold(&[player], &[attract, thrust]).is_err());
    assert!(
        world
            .hold(
                &[],
                &[Held {
                    strength: f64::INFINITY,
                    ..attract
                }]
            )
            .is_err()
    );
    assert_eq!(world.state().held, [thrust, attract]);
    world.step(&[], None).unwrap();
    free.step(&[], None).unwrap();
    assert!(world.state().balls != free.state().balls);
}
