//! A tick that fails after balls came goes back to a whole state.
//!
//! The copy of the last whole tick is also the scratch memory by which balls are put in spatial order. That left it with
//! as many ids as there are balls now, and radii and masses of the tick before some had come; the next copy into it took
//! those for the right ones, because count and common shape seemed to agree. A step that then failed went back to a
//! state with too few radii, and the tick after that ended the process.

use kuglice_step::{Input, InputKind, Model, NO_BALL, NewBall, Rules, Vec2, World, random};

fn input(kind: InputKind, sequence: u64, ball: u64, numbers: [f64; 6]) -> Input {
    Input {
        client: 1,
        sequence,
        kind,
        ball,
        numbers,
    }
}

fn spawn(sequence: u64, x: f64) -> Input {
    input(InputKind::Spawn, sequence, NO_BALL, [x, 95.0, 0.0, 0.0, 0.3, 1.0])
}

#[test]
fn a_failed_tick_goes_back_to_all_radii_and_masses() {
    let rules = Rules::new([0.0, 0.0, 100.0, 100.0], true, 1.0, 60.0, &[]).unwrap();
    let model = Model::new("verlet", "overlap", "loose_quadtree", 1, None).unwrap();
    let balls: Vec<_> = (0..3000u64)
        .map(|i| NewBall {
            position: Vec2::new(
                98.0 * random::uniform(5, 0, i) + 1.0,
                80.0 * random::uniform(5, 1, i) + 1.0,
            ),
            velocity: Vec2::new(1.0, 0.0),
            radius: 0.3,
            mass: 1.0,
        })
        .collect();
    let mut world = World::new(rules, model, &balls).unwrap();
    // The first tick puts the balls in spatial order, right after one has come.
    world.step(&[spawn(1, 10.0)], None).unwrap();
    assert!(!world.state().balls.is_by_id());
    let (before, hash) = (world.snapshot(), world.state_hash());

    let fast = [f64::MAX, 0.0, 0.0, 0.0, 0.0, 0.0];
    let kicks = [2, 3].map(|sequence| input(InputKind::Kick, sequence, 7, fast));
    assert!(world.step(&kicks, None).is_err());

    let state = world.state();
    assert_eq!(state.balls.radius.len(), state.balls.len());
    assert_eq!(state.balls.mass.len(), state.balls.len());
    assert_eq!(world.state_hash(), hash);
    assert_eq!(world.snapshot(), before);
    world.step(&[spawn(4, 20.0)], None).unwrap();
    assert_eq!(world.state().balls.len(), 3002);
}
