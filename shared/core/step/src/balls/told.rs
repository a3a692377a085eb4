//! Balls put right in place, by one who knows the truth.

use super::{Balls, NewBall};

impl Balls {
    /// Takes the balls `gone` out and puts `told` in, or right where they are already there; ids ascend in both. Balls that
    /// stay keep their place in memory as long as none comes and none goes.
    pub(crate) fn replace(&mut self, gone: &[u64], told: &[(u64, NewBall)]) {
        let missing = |&&(id, _): &&(u64, NewBall)| self.index_of(id).is_none();
        let comes = told.iter().any(|one| missing(&one));
        if comes || gone.iter().any(|&id| self.index_of(id).is_some()) {
            *self = self.merged(gone, told);
            return;
        }
        let mut same_shapes = true;
        for &(id, ball) in told {
            let index = self.index_of(id).expect("none is missing");
            self.position[index] = ball.position;
            self.velocity[index] = ball.velocity;
            same_shapes &= self.radius[index] == ball.radius && self.mass[index] == ball.mass;
            self.radius[index] = ball.radius;
            self.mass[index] = ball.mass;
        }
        if !same_shapes {
            self.uniform = self.find_uniform();
        }
    }

    /// A copy in id order, with `gone` taken out and `told` put in.
    fn merged(&self, gone: &[u64], told: &[(u64, NewBall)]) -> Balls {
        let mut merged = Balls::default();
        let mut told = told.iter().copied().peekable();
        let mut gone = gone.iter().copied().peekable();
        for index in self.by_id() {
            let id = self.id[index];
            while let Some((new, ball)) = told.next_if(|&(new, _)| new < id) {
                merged.push(new, ball);
            }
            while gone.next_if(|&other| other < id).is_some() {}
            let leaves = gone.peek() == Some(&id);
            if let Some((_, ball)) = told.next_if(|&(new, _)| new == id) {
                merged.push(id, ball);
            } else if !leaves {
                merged.push(id, self.ball(index));
            }
        }
        for (new, ball) in told {
            merged.push(new, ball);
        }
        merged
    }
}
