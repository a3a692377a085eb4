//! Threads are the caller's choice, and nothing of a world shows how many there were.

use kuglice_step::{Model, NewBall, Rules, Team, Vec2, World, random};

fn world(
    contacts: &str,
    broadphase: &str,
    count: u32,
    mixed: bool,
    restitution: f64,
    gravity: bool,
) -> World {
    let side = (f64::from(count) * 2.2).sqrt();
    let forces: &[(&str, &[f64])] = &[("gravity", &[0.0, -10.0])];
    let rules = Rules::new(
        [0.0, 0.0, side, side],
        true,
        restitution,
        60.0,
        if gravity { forces } else { &[] },
    );
    let balls: Vec<_> = (0..u64::from(count))
        .map(|i| {
            let number = |stream| random::uniform(3, stream, i);
            NewBall {
                position: Vec2::new(side * number(0), side * number(1)),
                velocity: Vec2::new(20.0 * number(2) - 10.0, 20.0 * number(3) - 10.0),
                radius: if mixed { 0.05 + number(4) } else { 0.4 },
                mass: if mixed { 0.1 + number(5) } else { 1.0 },
            }
        })
        .collect();
    let model = Model::new("verlet", contacts, broadphase, 1, None).unwrap();
    World::new(rules.unwrap(), model, &balls).unwrap()
}

/// Balls thrown together at random overlap a great deal at first: the order of pairs that share balls matters at once.
#[test]
fn one_or_many_give_the_same_states() {
    for (contacts, broadphase) in [
        ("overlap", "loose_quadtree"),
        ("overlap", "quadtree"),
        ("backtrack", "loose_quadtree"),
        ("event", "loose_quadtree"),
    ] {
        for (mixed, restitution, gravity) in [(false, 1.0, false), (true, 1.0, true), (true, 0.7, true)] {
            // Many collisions below restitution 1 take a while where all of them are computed.
            let count = if contacts == "event" && restitution < 1.0 {
                300
            } else {
                3000
            };
            let mut judge = world(contacts, broadphase, count, mixed, restitution, gravity);
            let mut hashes = Vec::new();
            for _ in 0..12 {
                judge.step(&[], None).unwrap();
                hashes.push(judge.state_hash());
            }
            for threads in [2, 3, 8] {
                let mut other = world(contacts, broadphase, count, mixed, restitution, gravity);
                other.employ(Team::new(threads).unwrap());
                for (tick, &hash) in hashes.iter().enumerate() {
                    other.step(&[], None).unwrap();
                    assert_eq!(
                        other.state_hash(),
                        hash,
                        "{contacts}, {broadphase}, mixed {mixed}, restitution {restitution}, {threads} threads, tick {tick}"
                    );
                }
            }
        }
    }
}
