//! Where all balls but a few feel the same, the few are told apart; to the bit it is as if each had been asked.

use super::*;
use crate::force::{self, HeldNow};
use crate::{NewBall, random};

const COUNT: u64 = 50;

fn balls() -> Balls {
    let mut balls = Balls::default();
    for i in 0..COUNT {
        let number = |stream| random::uniform(1, stream, i) - 0.5;
        let ball = NewBall {
            position: Vec2::new(number(0), number(1)),
            velocity: Vec2::new(number(2), number(3)),
            radius: 0.1,
            mass: 1.0 + number(4),
        };
        balls.push(i, ball);
    }
    balls
}

#[test]
fn thrust_on_a_few_moves_all_as_the_sum_per_ball_does() {
    let forces = [
        force::make("gravity", &[0.25, -10.0]).unwrap(),
        force::make("thrust", &[]).unwrap(),
        force::make("gravity", &[-0.0, 0.0]).unwrap(),
    ];
    let thrust = [0, 1, 17, COUNT as usize - 1].map(|index| (index, Vec2::new(3.0, 4.0 - index as f64)));
    for pieces in [0..COUNT as usize, 1..17, 18..30, 17..18] {
        for integrator in &TABLE {
            let mut ours = balls();
            let held = HeldNow {
                thrust: thrust.to_vec(),
                attract: Vec::new(),
            };
            let field = Field::new(&forces, &ours, held);
            let Field::Sum(sum) = &field else {
                panic!("thrust is no constant");
            };
            assert!(sum.constant_but_for().is_some());
            let mut theirs = balls();
            (integrator.advance)(bodies(&mut ours, pieces.clone()), &field, 0.0, 0.1);
            for index in pieces.clone() {
                let one = bodies(&mut theirs, index..index + 1);
                match integrator.name {
                    "euler" => each::<euler::Euler, _>(one, sum, 0.0, 0.1),
                    "symplectic_euler" => each::<symplectic_euler::SymplecticEuler, _>(one, sum, 0.0, 0.1),
                    "verlet" => each::<verlet::Verlet, _>(one, sum, 0.0, 0.1),
                    "rk4" => each::<rk4::RungeKutta4, _>(one, sum, 0.0, 0.1),
                    other => panic!("{other} is not compared"),
                }
            }
            assert_eq!(ours, theirs, "{} over {pieces:?}", integrator.name);
        }
    }
}

fn bodies(balls: &mut Balls, indices: std::ops::Range<usize>) -> Bodies<'_> {
    Bodies {
        start: indices.start,
        position: &mut balls.position[indices.clone()],
        velocity: &mut balls.velocity[indices.clone()],
        mass: &balls.mass[indices],
    }
}
