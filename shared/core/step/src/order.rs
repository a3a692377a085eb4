//! Where the balls of each id stand in memory.
//!
//! Memory order is nobody's business but the cache's: neighbours in the plane are kept near each other in memory, and
//! whatever has to be in id order asks here. While memory order is id order, as in small worlds, nothing is stored.

use crate::team::{GRAIN, Team};

/// Indices in id order.
#[derive(Debug, Default)]
pub(crate) struct Order {
    /// Empty: id order is memory order.
    by_id: Vec<u32>,
}

// Written out so that clone_from keeps the memory that is there.
impl Clone for Order {
    fn clone(&self) -> Order {
        Order {
            by_id: self.by_id.clone(),
        }
    }

    fn clone_from(&mut self, source: &Order) {
        self.by_id.clone_from(&source.by_id);
    }
}

impl Order {
    /// Whether memory order is id order.
    #[inline]
    pub(crate) fn is_by_id(&self) -> bool {
        self.by_id.is_empty()
    }

    /// All indices in id order, where that is not memory order.
    pub(crate) fn indices(&self) -> Option<&[u32]> {
        (!self.is_by_id()).then_some(&self.by_id)
    }

    /// The index of the ball with the `rank`-th lowest id.
    #[inline]
    pub(crate) fn index(&self, rank: usize) -> usize {
        if self.by_id.is_empty() {
            rank
        } else {
            self.by_id[rank] as usize
        }
    }

    /// The last ball in memory is new, and has the highest id.
    pub(crate) fn push(&mut self, index: usize) {
        if !self.by_id.is_empty() {
            self.by_id.push(index as u32);
        }
    }

    /// The ball at `index` goes; those behind it move up.
    pub(crate) fn remove(&mut self, index: usize) {
        let index = index as u32;
        self.by_id.retain(|&other| other != index);
        for other in &mut self.by_id {
            *other -= u32::from(*other > index);
        }
    }

    /// Balls were moved in memory: `place[i]` is where the one from index i is now.
    pub(crate) fn moved(&mut self, place: &[u32], team: &Team) {
        if self.by_id.is_empty() {
            self.by_id.extend_from_slice(place);
        } else {
            team.each(&mut self.by_id[..], GRAIN, &|indices| {
                for index in indices {
                    *index = place[*index as usize];
                }
            });
        }
    }

    /// Becomes the way back: where each index of `order` is found in it.
    pub(crate) fn invert(&mut self, order: &[u32]) -> &[u32] {
        self.by_id.clear();
        self.by_id.resize(order.len(), 0);
        for (place, &index) in (0..).zip(order) {
            self.by_id[index as usize] = place;
        }
        &self.by_id
    }
}

#[cfg(test)]
mod tests {
    use super::Order;
    use crate::{Balls, NewBall, Team, Vec2};
    use proptest::prelude::*;

    fn ball(x: f64) -> NewBall {
        NewBall {
            position: Vec2::new(x, -x),
            velocity: Vec2::new(2.0 * x, 0.0),
            radius: 1.0 + x,
            mass: 2.0 + x,
        }
    }

    #[derive(Clone, Debug)]
    enum Change {
        Push,
        Remove(usize),
        Arrange(u64),
    }

    fn change() -> impl Strategy<Value = Change> {
        prop_oneof![
            3 => Just(Change::Push),
            1 => any::<usize>().prop_map(Change::Remove),
            1 => any::<u64>().prop_map(Change::Arrange),
        ]
    }

    fn shuffled(count: usize, seed: u64) -> Vec<u32> {
        let mut order: Vec<u32> = (0..count as u32).collect();
        order.sort_by_key(|&index| (u64::from(index) + 1).wrapping_mul(seed | 1).rotate_left(23));
        order
    }

    proptest! {
        #[test]
        fn every_ball_is_found_by_its_id_wherever_it_stands(changes in prop::collection::vec(change(), 0..60)) {
            let (mut balls, mut model) = (Balls::default(), Vec::new());
            // Both halves of an id are told apart.
            let mut next = u64::from(u32::MAX) - 10;
            for change in changes {
                match change {
                    Change::Push => {
                        balls.push(next, ball(next as f64));
                        model.push(next);
                        next += 1;
                    }
                    Change::Remove(which) if !model.is_empty() => {
                        let id = model.remove(which % model.len());
                        balls.remove(balls.index_of(id).unwrap());
                    }
                    Change::Arrange(seed) => {
                        let order = shuffled(model.len(), seed);
                        balls.arrange(&order, &mut Vec::new(), &mut Order::default(), &Team::default());
                    }
                    Change::Remove(_) => {}
                }
            }
            prop_assert_eq!(balls.by_id().map(|index| balls.id[index]).collect::<Vec<_>>(), model.clone());
            for id in model {
                let index = balls.index_of(id).unwrap();
                let expected = ball(id as f64);
                prop_assert_eq!(balls.position[index], expected.position);
                prop_assert_eq!(balls.velocity[index], expected.velocity);
                prop_assert_eq!((balls.radius[index], balls.mass[index]), (expected.radius, expected.mass));
            }
            prop_assert_eq!(balls.index_of(next), None);
        }
    }
}
