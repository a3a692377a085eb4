//! Balls moved in memory.

use super::Balls;
use crate::Vec2;
use crate::order::Order;
use crate::team::{GRAIN, Team};

impl Balls {
    /// Moves the balls in memory: the one from index `order[i]` is at index i afterwards. `spare` and `back` lend their
    /// memory.
    pub(crate) fn arrange(&mut self, order: &[u32], spare: &mut Vec<Vec2>, back: &mut Order, team: &Team) {
        debug_assert_eq!(order.len(), self.len());
        spare.resize(order.len(), Vec2::ZERO);
        for vectors in [&mut self.position, &mut self.velocity] {
            gather(spare, order, team, |index| vectors[index]);
            std::mem::swap(vectors, spare);
        }
        // In halves, which an f64 holds exactly, an id needs no memory of another kind.
        gather(spare, order, team, |index| {
            let id = self.id[index];
            Vec2::new(f64::from((id >> 32) as u32), f64::from(id as u32))
        });
        team.each((&mut self.id[..], &spare[..]), GRAIN, &|(ids, halves)| {
            for (id, half) in ids.iter_mut().zip(halves) {
                *id = (half.x as u64) << 32 | half.y as u64;
            }
        });
        if self.uniform.is_none() {
            gather(spare, order, team, |index| {
                Vec2::new(self.radius[index], self.mass[index])
            });
            let shapes = (&mut self.radius[..], &mut self.mass[..], &spare[..]);
            team.each(shapes, GRAIN, &|(radii, masses, shapes)| {
                for ((radius, mass), shape) in radii.iter_mut().zip(masses).zip(shapes) {
                    (*radius, *mass) = (shape.x, shape.y);
                }
            });
        }
        self.order.moved(back.invert(order), team);
    }
}

/// Puts what is at index `order[i]` into place i.
fn gather(places: &mut [Vec2], order: &[u32], team: &Team, from: impl Fn(usize) -> Vec2 + Sync) {
    team.each((places, order), GRAIN, &|(places, order)| {
        for (place, &index) in places.iter_mut().zip(order) {
            *place = from(index as usize);
        }
    });
}
