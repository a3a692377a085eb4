//! What is packed comes back, within the bound that is told; what was not packed is refused, whatever it is.

use std::f64::consts::PI;

use kuglice_regions::{Gatherer, Grid, Quanta, Shapes, pack, unpack};
use kuglice_step::{Balls, NewBall, Vec2};
use proptest::prelude::*;

const QUANTA: Quanta = Quanta {
    position: 1.0 / 256.0,
    velocity: 1.0 / 64.0,
};

fn grid(depth: u32) -> Grid {
    Grid::new([-50.0, -20.0, 50.0, 20.0], depth).unwrap()
}

fn shape() -> impl Strategy<Value = (f64, f64)> {
    prop_oneof![
        Just((0.5, 1.0)),
        Just((0.25, f64::INFINITY)),
        (0.01f64..10.0).prop_map(|r| (r, PI * r * r)),
        (0.01f64..10.0, 0.1f64..9.0),
    ]
}

prop_compose! {
    fn balls()(rows in prop::collection::vec(
        (1u64..9000, -70.0f64..70.0, -30.0f64..30.0, -99.0f64..99.0, -99.0f64..99.0, shape()), 0..60
    ), one in any::<bool>()) -> Balls {
        let mut balls = Balls::default();
        let mut id = 0;
        for (gap, x, y, vx, vy, (radius, mass)) in rows {
            id += gap;
            let (radius, mass) = if one { (0.5, 1.0) } else { (radius, mass) };
            let (position, velocity) = (Vec2::new(x, y), Vec2::new(vx, vy));
            balls.push(id, NewBall { position, velocity, radius, mass });
        }
        balls
    }
}

fn table() -> Shapes {
    Shapes::new(&[(0.5, 1.0), (0.25, f64::INFINITY)]).unwrap()
}

proptest! {
    #[test]
    fn every_ball_is_in_one_node_and_comes_back_within_half_a_step(balls in balls(), depth in 0u32..4) {
        let grid = grid(depth);
        let every: Vec<u32> = (0..grid.nodes() as u32).rev().collect();
        let mut gatherer = Gatherer::default();
        let gathered = gatherer.gather(&grid, &balls, &every);
        let mut seen = 0;
        for (place, &node) in every.iter().enumerate() {
            let indices = gathered.node(place);
            let (bytes, left_out) = pack(&grid, QUANTA, &table(), &balls, indices);
            prop_assert_eq!(left_out, 0);
            let told = unpack(&grid, QUANTA, &table(), &bytes, 1000).unwrap();
            prop_assert_eq!(told.len(), indices.len());
            for (&index, (id, ball)) in indices.iter().zip(told) {
                let index = index as usize;
                let (position, velocity) = (balls.position[index], balls.velocity[index]);
                prop_assert_eq!(grid.node(position), node);
                prop_assert_eq!(id, balls.id[index]);
                let bound = |step: f64| 0.5 * step * (1.0 + 1e-9);
                prop_assert!((ball.position.x - position.x).abs() <= bound(QUANTA.position));
                prop_assert!((ball.position.y - position.y).abs() <= bound(QUANTA.position));
                prop_assert!((ball.velocity.x - velocity.x).abs() <= bound(QUANTA.velocity));
                prop_assert!((ball.velocity.y - velocity.y).abs() <= bound(QUANTA.velocity));
                prop_assert!((ball.radius / balls.radius[index] - 1.0).abs() <= 6e-8);
                prop_assert!(ball.mass == balls.mass[index] || (ball.mass / balls.mass[index] - 1.0).abs() <= 2e-7);
            }
            seen += indices.len();
        }
        prop_assert_eq!(seen, balls.len());
    }

    #[test]
    fn bytes_cut_short_or_grown_are_refused(balls in balls(), cut in any::<prop::sample::Index>()) {
        let all: Vec<u32> = (0..balls.len() as u32).collect();
        let (mut bytes, _) = pack(&grid(0), QUANTA, &table(), &balls, &all);
        let short = &bytes[..cut.index(bytes.len())];
        prop_assert!(unpack(&grid(0), QUANTA, &table(), short, 1000).is_err());
        bytes.push(0);
        prop_assert!(unpack(&grid(0), QUANTA, &table(), &bytes, 1000).is_err());
    }

    #[test]
    fn any_bytes_are_balls_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..60)) {
        if let Ok(told) = unpack(&grid(0), QUANTA, &table(), &bytes, 100) {
            prop_assert!(told.len() <= 100);
            prop_assert!(told.is_sorted_by(|a, b| a.0 < b.0));
            prop_assert!(told.iter().all(|(_, ball)| ball.check().is_ok()));
        }
    }
}

#[test]
fn a_ball_too_far_away_to_be_told_is_left_out() {
    let mut balls = Balls::default();
    for (id, x) in [(3, 1.0), (4, 1e300), (9, 2.0)] {
        let (position, velocity) = (Vec2::new(x, 0.0), Vec2::ZERO);
        balls.push(
            id,
            NewBall {
                position,
                velocity,
                radius: 0.5,
                mass: 1.0,
            },
        );
    }
    let (bytes, left_out) = pack(&grid(0), QUANTA, &table(), &balls, &[0, 1, 2]);
    let told = unpack(&grid(0), QUANTA, &table(), &bytes, 3).unwrap();
    assert_eq!(left_out, 1);
    assert_eq!(told.iter().map(|&(id, _)| id).collect::<Vec<_>>(), [3, 9]);
}

#[test]
fn more_balls_than_are_awaited_are_refused_before_any_is_read() {
    // 2^40 balls of no bits each.
    let bytes = [0x80, 0x80, 0x80, 0x80, 0x80, 0x20, 0, 0, 0, 0];
    let error = unpack(&grid(0), QUANTA, &table(), &bytes, 1000).unwrap_err();
    assert_eq!(error.to_string(), "1099511627776 balls, at most 1000");
}

#[test]
fn equal_balls_of_a_large_world_take_about_eight_bytes() {
    let mut balls = Balls::default();
    let number = |stream, i| kuglice_step::random::uniform(3, stream, i);
    // A node of 61 among 1,000,000: packing 0.3 of radius 0.5, ids far apart.
    for i in 0..61 {
        let position = Vec2::new(12.6 * number(0, i), 12.6 * number(1, i));
        let velocity = Vec2::new(10.0 * number(2, i) - 5.0, 10.0 * number(3, i) - 5.0);
        let id = 16_384 * i + (16_384.0 * number(4, i)) as u64;
        balls.push(
            id,
            NewBall {
                position,
                velocity,
                radius: 0.5,
                mass: 1.0,
            },
        );
    }
    let all: Vec<u32> = (0..61).collect();
    let (bytes, _) = pack(&grid(0), QUANTA, &table(), &balls, &all);
    assert!(bytes.len() <= 61 * 8, "{} bytes", bytes.len());
}
