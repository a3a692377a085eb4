//! However pairs are found, in pieces or not, they are treated as if one after the other in order of (lower id, higher id).

use super::*;
use crate::broadphase::Part;
use crate::order::Order;
use crate::{NewBall, Vec2};
use proptest::prelude::*;

/// Finds what it is told.
struct Told(Vec<Pair>);

impl Broadphase for Told {
    fn build(&mut self, _: &Discs<'_>, _: &Team) {}

    fn pairs_of(&self, _: &Discs<'_>, part: Part, found: &mut Vec<Pair>) {
        found.extend(self.0.iter().skip(part.number).step_by(part.of));
    }

    fn relocate(&mut self, _: usize, _: Vec2, _: f64) {}

    fn query(&self, _: Vec2, _: f64, _: &mut Vec<u32>) {}

    fn nodes(&self) -> Vec<[f64; 4]> {
        Vec::new()
    }
}

fn balls(count: usize, order: &[u32]) -> Balls {
    let mut balls = Balls::default();
    for id in 0..count {
        let number = id as f64;
        let ball = NewBall {
            position: Vec2::new(number, 1.0),
            velocity: Vec2::new(1.0 + number, 0.5),
            radius: 0.5,
            mass: 1.0,
        };
        balls.push(id as u64 * 3, ball);
    }
    balls.arrange(order, &mut Vec::new(), &mut Order::default(), &Team::default());
    balls
}

/// Something that depends on the order, and comes of two pairs in three.
struct TwoInThree;

impl Rule<Vec2> for TwoInThree {
    fn may(&self, balls: &Balls, first: usize, second: usize) -> bool {
        (balls.id[first] + balls.id[second]) % 3 != 1
    }

    fn outcome(&self, balls: &Balls, first: usize, second: usize) -> Option<Vec2> {
        let (a, b) = (balls.velocity[first], balls.velocity[second]);
        let mixed = Vec2::new((a.x * 3.0 + b.x).rem_euclid(101.0), a.y + 2.0 * b.y);
        self.may(balls, first, second).then_some(mixed)
    }
}

fn apply(balls: &mut Balls, first: usize, second: usize, mixed: Vec2) {
    balls.velocity[first] = mixed;
    balls.velocity[second] = Vec2::new(mixed.y, mixed.x);
}

/// Pairs, each once: chains and stars of many that share balls, and couples that share none.
fn pairs(count: usize) -> impl Strategy<Value = Vec<Pair>> {
    prop::collection::btree_set((0..count as u32, 0..count as u32), 0..3 * count).prop_map(|pairs| {
        let ordered = pairs
            .into_iter()
            .filter(|(a, b)| a != b)
            .map(|(a, b)| (a.min(b), a.max(b)));
        let unique: std::collections::BTreeSet<Pair> = ordered.collect();
        unique.into_iter().collect()
    })
}

fn case() -> impl Strategy<Value = (Vec<u32>, Vec<Pair>)> {
    (2usize..60).prop_flat_map(|count| {
        let order = Just((0..count as u32).collect::<Vec<_>>()).prop_shuffle();
        (order, pairs(count).prop_shuffle())
    })
}

proptest! {
    #[test]
    fn as_if_in_order_of_the_ids((order, told) in case(), threads in prop::sample::select(vec![1usize, 2, 3, 8])) {
        let team = Team::new(threads).unwrap();
        let start = balls(order.len(), &order);
        let mut judge = start.clone();
        let mut in_order: Vec<_> = told.iter().map(|&pair| by_id(&judge, pair)).collect();
        in_order.sort_unstable_by_key(|&(a, b)| (judge.id[a], judge.id[b]));
        let mut expected = 0;
        for (first, second) in in_order {
            if let Some(mixed) = TwoInThree.outcome(&judge, first, second) {
                apply(&mut judge, first, second, mixed);
                expected += 1;
            }
        }

        // Twice, for what the first time may leave behind.
        let mut pairs = Pairs::default();
        for _ in 0..2 {
            let mut treated = start.clone();
            pairs.find(&treated, &mut Told(told.clone()), &team);
            prop_assert_eq!(pairs.treat(&mut treated, &team, &TwoInThree, &mut apply), expected);
            prop_assert_eq!(&treated.velocity, &judge.velocity);
            prop_assert!(pairs.counts.iter().all(|&count| count == 0));
        }
    }
}
