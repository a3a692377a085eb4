//! A pair that shares no ball with another is treated in whatever order it was found.

use super::*;
use crate::NewBall;
use proptest::prelude::*;

fn ball(x: f64, y: f64, u: f64, v: f64, mass: f64) -> NewBall {
    NewBall {
        position: Vec2::new(x, y),
        velocity: Vec2::new(u, v),
        radius: 0.5,
        mass,
    }
}

proptest! {
    #[test]
    fn either_order_gives_the_same_bits(
        (x, y) in (-0.9..0.9f64, -0.9..0.9f64), (u, v) in (-9.0..9.0f64, -9.0..9.0f64),
        mass in prop::sample::select(vec![0.1, 1.0, 7.3, f64::INFINITY]), restitution in 0.0..1.0f64,
    ) {
        let mut balls = Balls::default();
        balls.push(0, ball(0.0, 0.0, 1.0, -2.0, 3.0));
        balls.push(1, ball(x, y, u, v, mass));
        let rule = Approaching(SharesOf::new(&balls, restitution));
        let bits = |velocities: Option<[Vec2; 2]>| velocities.map(|both| both.map(|v| (v.x.to_bits(), v.y.to_bits())));
        let (there, back) = (rule.outcome(&balls, 0, 1), rule.outcome(&balls, 1, 0));
        prop_assert_eq!(bits(there), bits(back.map(|[v1, v2]| [v2, v1])));
        prop_assert_eq!(rule.may(&balls, 0, 1), there.is_some());
        prop_assert_eq!(rule.may(&balls, 1, 0), there.is_some());
    }
}

#[test]
fn two_in_one_place_are_treated_in_the_order_of_their_ids() {
    let mut balls = Balls::default();
    balls.push(4, ball(1.0, 1.0, 2.0, 0.0, 1.0));
    balls.push(9, ball(1.0, 1.0, -2.0, 0.0, 1.0));
    let rule = Approaching(SharesOf::new(&balls, 1.0));
    assert!(rule.may(&balls, 0, 1) && rule.may(&balls, 1, 0));
    assert_eq!(
        (rule.in_order(&balls, (0, 1)), rule.in_order(&balls, (1, 0))),
        ((0, 1), (0, 1))
    );
    assert!(rule.outcome(&balls, 0, 1).is_some() && rule.outcome(&balls, 1, 0).is_none());
}
