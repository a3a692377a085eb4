//! Large worlds keep neighbours together in memory. Nothing that can be seen of a world depends on it: the classical
//! quadtree knows no such order, so its worlds stay in id order and judge those of the loose one.

use kuglice_step::{Input, InputKind, Model, NO_BALL, NewBall, Rules, Vec2, World, random};

const BALLS: u32 = 2500;
const TICKS: u64 = 100;

fn world(contacts: &str, broadphase: &str, mixed: bool, gravity: bool) -> World {
    let forces: &[(&str, &[f64])] = &[("gravity", &[0.0, -10.0])];
    let rules = Rules::new(
        [0.0, 0.0, 100.0, 60.0],
        true,
        1.0,
        60.0,
        if gravity { forces } else { &[] },
    );
    let model = Model::new("verlet", contacts, broadphase, 1, None).unwrap();
    // Not in rows of cells, so that arranging has something to do.
    let mut places: Vec<u32> = (0..BALLS).collect();
    places.sort_by_key(|&i| random::uniform(7, 3, u64::from(i)).to_bits());
    let balls: Vec<_> = (places.into_iter().zip(0u64..))
        .map(|(place, i)| {
            let number = |stream| random::uniform(7, stream, i);
            let radius = if mixed { 0.1 + 0.5 * number(2) } else { 0.55 };
            NewBall {
                position: Vec2::new(
                    1.0 + 1.6 * f64::from(place % 61),
                    1.0 + 1.4 * f64::from(place / 61),
                ),
                velocity: Vec2::new(16.0 * number(0) - 8.0, 16.0 * number(1) - 8.0),
                radius,
                mass: radius * radius,
            }
        })
        .collect();
    World::new(rules.unwrap(), model, &balls).unwrap()
}

fn input(kind: InputKind, sequence: u64, ball: u64, numbers: [f64; 6]) -> Input {
    Input {
        client: 1,
        sequence,
        kind,
        ball,
        numbers,
    }
}

/// Balls come, go and are kicked while the memory is put in order again and again.
fn inputs(tick: u64) -> Vec<Input> {
    let x = 5.0 + (tick % 90) as f64;
    match tick % 10 {
        0 => vec![input(
            InputKind::Spawn,
            tick,
            NO_BALL,
            [x, 30.0, 1.0, 2.0, 0.3, 0.2],
        )],
        3 => vec![input(InputKind::Remove, tick, 17 * tick, [0.0; 6])],
        6 => vec![input(
            InputKind::Kick,
            tick,
            11 * tick,
            [3.0, -2.0, 0.0, 0.0, 0.0, 0.0],
        )],
        _ => vec![],
    }
}

#[test]
fn it_does_not_show() {
    for contacts in ["overlap", "backtrack", "event"] {
        for (mixed, gravity) in [(false, false), (true, true)] {
            let mut arranged = world(contacts, "loose_quadtree", mixed, gravity);
            let mut judge = world(contacts, "quadtree", mixed, gravity);
            let mut again = arranged.clone();
            for tick in 0..TICKS {
                arranged.step(&inputs(tick), None).unwrap();
                judge.step(&inputs(tick), None).unwrap();
                again.step(&inputs(tick), None).unwrap();
                if tick % 50 == 20 {
                    again.copy_from(&arranged);
                } else if tick % 50 == 40 {
                    let bytes = again.snapshot();
                    again = World::restore(again.rules().clone(), again.model().clone(), &bytes).unwrap();
                }
                let what = format!("{contacts}, mixed {mixed}, gravity {gravity}, tick {tick}");
                assert_eq!(arranged.state_hash(), judge.state_hash(), "{what}");
                assert_eq!(again.state_hash(), judge.state_hash(), "{what}");
            }
            assert!(judge.state().balls.is_by_id());
            assert!(!arranged.state().balls.is_by_id());
            assert!(arranged.state() == judge.state());
            assert_eq!(arranged.snapshot(), judge.snapshot());
            assert_eq!(
                arranged.kinetic_energy().to_bits(),
                judge.kinetic_energy().to_bits()
            );
            assert_eq!(
                arranged.potential_energy().to_bits(),
                judge.potential_energy().to_bits()
            );
            let pairs = |world: &mut World| -> Vec<(u64, u64)> {
                let found = world.overlapping();
                let id = &world.state().balls.id;
                found
                    .iter()
                    .map(|&(a, b)| (id[a as usize], id[b as usize]))
                    .collect()
            };
            assert_eq!(pairs(&mut arranged), pairs(&mut judge));
        }
    }
}
